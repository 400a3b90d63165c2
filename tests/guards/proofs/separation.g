# The separation of a pass (lib/toi/advance.cpp, class Separation): what rounding may take, and that 64 bits hold it.
# Lengths in the pair's unit, times in the horizon's. Names as in the code; X_ is what is computed, X what it stands for.
# Run: gappa separation.g. Printed bounds are those of DESIGN.md, "Never late".

@unit30 = fixed<-30,ne>;   # Q30, to nearest
@unit29 = fixed<-29,ne>;   # Q29, to nearest
@down30 = fixed<-30,dn>;   # Q30, down
@down29 = fixed<-29,dn>;   # Q29, down
@down56 = fixed<-56,dn>;   # Q56, down

# One component of the axis in a body's frame: a sum of three products of numbers of 30 bits, exact, rounded to 29 bits.
local_ = unit29(local);
# One component of n x u: rounded to 29 bits, then pulled into the body's frame and rounded again.
slope_world_ = unit29(slope_world);
slope_ = unit29(slope_pulled);
# One component of the direction at time x after the pass' start.
moved = slope_ * x;
moved_ = down29(moved);
along_ = local_ + moved_;

# The share of a body: direction . vertex, shifted down to 56 bits. |vertex| <= 1/2 of the pair's unit, |direction| <= 4.
share_ = down56(share);
# The centre: n . C, exact in 60 bits, shifted to 56; its slope to 30 bits, its way over x to 56.
centre_ = down56(centre);
rate_ = down30(rate);
drift = rate_ * x;
drift_ = down56(drift);
# K x^2 / 2: x^2 down to 30 bits and one more, so never too small.
square = x * x;
square_ = down30(square);
bend = curvature * (square_ + 0x1p-30) * 0.5;

sum_ = centre_ + drift_ + share_a_ + share_b_ - bend;

{ local in [-1.001, 1.001] /\ slope_world in [-2.01, 2.01] /\ slope_pulled in [-2.02, 2.02] /\ x in [0, 1] /\
  share in [-2, 2] /\ centre in [-1.001, 1.001] /\ rate in [-5.1, 5.1] /\ curvature in [0, 32] /\
  share_a_ in [-2, 2] /\ share_b_ in [-2, 2]
  ->
  # rounding of a component: half a step each; of the moved one a whole step more
  local_ - local in [-0x1p-30, 0x1p-30] /\
  slope_world_ - slope_world in [-0x1p-30, 0x1p-30] /\
  slope_ - slope_pulled in [-0x1p-30, 0x1p-30] /\
  moved_ - moved in [-0x1p-29, 0] /\
  along_ in [-4, 4] /\
  # shares and centre lose less than 2^-26 ulp each, downwards
  share_ - share in [-0x1p-56, 0] /\
  centre_ - centre in [-0x1p-56, 0] /\
  drift_ - drift in [-0x1p-56, 0] /\
  rate_ - rate in [-0x1p-30, 0] /\
  # with the 2^-30 that is added to it, the square is never too small
  square_ - square in [-0x1p-30, 0] /\
  # and nothing leaves 64 bits: 2^63 2^-56 = 128
  sum_ in [-127, 127] }
