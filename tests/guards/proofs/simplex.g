# The exact products of the simplex (lib/distance/simplex.h): the width of every degree. Vertices of the difference lie
# within 2^30 of the origin by construction of the block; a, b, c are norms, e and f of differences.

{ a in [0, 0x1p30] /\ b in [0, 0x1p30] /\ e in [0, 0x1p31] /\ f in [0, 0x1p31]
  ->
  a * b in [0, 0x1p60] /\            # a.b, |a x b|
  e * f in [0, 0x1p62] /\            # edge squares, normals: 64 bits
  e * f * a in [0, 0x1p92] /\        # determinants
  a * b * (e * f) in [0, 0x1p122] /\ # weights of a triangle
  (e * e) * (a * f) + (a * e) * (e * f) in [0, 0x1p124] }   # a vertex against an edge: 128 bits
