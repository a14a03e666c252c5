// A quarter of a ring between the radii 1 and 2, lined to the radius 1.4
radii[] = {1, 1.4, 2};
Point(1) = {0, 0, 0};
For i In {0:2}
  Point(10 + i) = {radii[i], 0, 0}; Point(20 + i) = {0, radii[i], 0};
  Circle(30 + i) = {10 + i, 1, 20 + i};
EndFor
For i In {0:1}
  Line(40 + i) = {10 + i, 11 + i}; Line(50 + i) = {21 + i, 20 + i};
  Curve Loop(i + 1) = {40 + i, 31 + i, 50 + i, -(30 + i)}; Plane Surface(i + 1) = {i + 1};
EndFor
Transfinite Curve {30:32} = 4; Transfinite Curve {40, 41, 50, 51} = 2;
Transfinite Surface "*"; Recombine Surface "*";
Physical Curve("inner") = {30}; Physical Curve("outer") = {32};
Physical Curve("plane y") = {40, 41}; Physical Curve("plane x") = {50, 51};
Physical Surface("lining", 1) = {1}; Physical Surface("ground", 2) = {2};
