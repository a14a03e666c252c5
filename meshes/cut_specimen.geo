// A quarter of a strip with two symmetric edge cuts: half width 1 m, half
// height 2 m, half ligament 0.5 m. The cuts have no width; the part of the
// bottom edge beyond the ligament is their free face.
half_width = 1;
half_height = 2;
ligament = 0.5;
n = 2;                       // cells along the ligament and along the cut

Point(1) = {0, 0, 0};
Point(2) = {ligament, 0, 0};
Point(3) = {half_width, 0, 0};
Point(4) = {half_width, half_height, 0};
Point(5) = {ligament, half_height, 0};
Point(6) = {0, half_height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6};
Curve Loop(2) = {2, 3, 4, -7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve {1, 2, 4, 5} = n + 1;
Transfinite Curve {3, 6, 7} = 4 * n + 1;
Transfinite Surface {1, 2};
Recombine Surface {1, 2};

Physical Curve("ligament") = {1};
Physical Curve("cut") = {2};
Physical Curve("side") = {3};
Physical Curve("grip") = {4, 5};
Physical Curve("axis") = {6};
Physical Surface("strip", 1) = {1, 2};
