// An octant of a hollow sphere, radii 1 and 2, in three hexahedra
Point(1) = {0, 0, 0};
r[] = {1, 2};
For i In {0:1}
  s = r[i]; a = s / Sqrt(2); b = s / Sqrt(3); n = 10 * (i + 1);
  Point(n + 1) = {s, 0, 0}; Point(n + 2) = {0, s, 0}; Point(n + 3) = {0, 0, s};
  Point(n + 4) = {a, a, 0}; Point(n + 5) = {0, a, a}; Point(n + 6) = {a, 0, a};
  Point(n + 7) = {b, b, b};
  Circle(n + 1) = {n + 1, 1, n + 4}; Circle(n + 2) = {n + 4, 1, n + 2}; Circle(n + 3) = {n + 2, 1, n + 5};
  Circle(n + 4) = {n + 5, 1, n + 3}; Circle(n + 5) = {n + 3, 1, n + 6}; Circle(n + 6) = {n + 6, 1, n + 1};
  Circle(n + 7) = {n + 4, 1, n + 7}; Circle(n + 8) = {n + 5, 1, n + 7}; Circle(n + 9) = {n + 6, 1, n + 7};
  Curve Loop(n + 1) = {n + 1, n + 7, -(n + 9), n + 6}; Surface(n + 1) = {n + 1} In Sphere {1};
  Curve Loop(n + 2) = {n + 2, n + 3, n + 8, -(n + 7)}; Surface(n + 2) = {n + 2} In Sphere {1};
  Curve Loop(n + 3) = {n + 4, n + 5, n + 9, -(n + 8)}; Surface(n + 3) = {n + 3} In Sphere {1};
EndFor
For k In {1:7}
  Line(30 + k) = {10 + k, 20 + k};
EndFor
Curve Loop(31) = {31, 21, -34, -11}; Plane Surface(31) = {31}; Curve Loop(32) = {34, 22, -32, -12}; Plane Surface(32) = {32};
Curve Loop(33) = {32, 23, -35, -13}; Plane Surface(33) = {33}; Curve Loop(34) = {35, 24, -33, -14}; Plane Surface(34) = {34};
Curve Loop(35) = {33, 25, -36, -15}; Plane Surface(35) = {35}; Curve Loop(36) = {36, 26, -31, -16}; Plane Surface(36) = {36};
Curve Loop(37) = {34, 27, -37, -17}; Plane Surface(37) = {37}; Curve Loop(38) = {35, 28, -37, -18}; Plane Surface(38) = {38};
Curve Loop(39) = {36, 29, -37, -19}; Plane Surface(39) = {39};
Surface Loop(1) = {11, 21, 31, 37, 39, 36}; Volume(1) = {1};
Surface Loop(2) = {12, 22, 32, 33, 38, 37}; Volume(2) = {2};
Surface Loop(3) = {13, 23, 34, 35, 39, 38}; Volume(3) = {3};
Transfinite Curve "*" = 2; Transfinite Surface "*"; Recombine Surface "*"; Transfinite Volume "*";
Physical Surface("inner") = {11:13}; Physical Surface("outer") = {21:23};
Physical Surface("plane z") = {31, 32}; Physical Surface("plane x") = {33, 34}; Physical Surface("plane y") = {35, 36};
Physical Volume("body", 1) = {1:3};
