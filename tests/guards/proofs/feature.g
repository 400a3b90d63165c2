# Widths of the features' conditions (lib/toi/feature_cubic.h, feature_span.cpp): corners in 29 bits and a sign, as
# Shortening leaves them, the ball at most an eighth of that where products are made (is_blind). Names as in the code.
# Run: gappa feature.g

# A component of a moment p x q, and of the one in the middle, twice: 64 bits.
moment = p_y * q_z - p_z * q_y;
middle = moment + moment_other;
# The magnitudes of the components of three moments, and what is added for the second and third order: 64 bits.
moments = 3 * moment_size + 3 * moment_size + 3 * moment_size;
slope = moments + 18 * ball * reach + 6 * ball * ball;
moment_error = 2 * ball * (2 * reach + ball);
# A volume, the cubic's coefficients and their error: 128 bits.
volume = moment_x * r_x + moment_y * r_y + moment_z * r_z;
outer = 3 * volume;
inner = volume + (middle_x * r_x + middle_y * r_y + middle_z * r_z);
error = 3 * (slope * ball);
# From four places: volumes in 58 bits, weights up to 32 in Q28, factors up to 18.
weighted = short_volume * (18 * weight);
reduced = weighted + weighted_1 + weighted_2 + weighted_3;
# A support along a direction of 30 bits, and what the ball takes of it, at most the reach and 1 there: 64 bits.
support = d_x * r_x + d_y * r_y + d_z * r_z;
taken = wide_ball * (d_size + d_size + d_size);

{ |p_y| <= 0x1p29 /\ |p_z| <= 0x1p29 /\ |q_y| <= 0x1p29 /\ |q_z| <= 0x1p29 /\
  |r_x| <= 0x1p29 /\ |r_y| <= 0x1p29 /\ |r_z| <= 0x1p29 /\ reach in [0, 0x1p29] /\ ball in [0, 0x1p26] /\
  |moment_other| <= 0x1p59 /\ moment_size in [0, 0x1p59] /\
  |moment_x| <= 0x1p59 /\ |moment_y| <= 0x1p59 /\ |moment_z| <= 0x1p59 /\
  |middle_x| <= 0x1p60 /\ |middle_y| <= 0x1p60 /\ |middle_z| <= 0x1p60 /\
  |short_volume| <= 0x1p58 /\ weight in [0, 0x1p33] /\
  |weighted_1| <= 0x1p96 /\ |weighted_2| <= 0x1p96 /\ |weighted_3| <= 0x1p96 /\
  |d_x| <= 0x1p30 /\ |d_y| <= 0x1p30 /\ |d_z| <= 0x1p30 /\ d_size in [0, 0x1p30] /\ wide_ball in [0, 0x1p30]
->
  |moment| <= 0x1p59 /\ |middle| <= 0x1p60 /\ slope <= 0x1.5p62 /\ moment_error <= 0x1.1p57 /\
  |volume| <= 0x1.8p89 /\ |outer| <= 0x1.2p91 /\ |inner| <= 0x1.2p91 /\ error <= 0x1.2p90 /\
  |weighted| <= 0x1.2p95 /\ |reduced| <= 0x1p98 /\ |support| <= 0x1.8p60 /\ taken <= 0x1.8p61 }
