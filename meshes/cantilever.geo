// Cantilever of 400 mm x 100 mm, ten cells high.
h = 0.01;
Point(1) = {0, 0, 0, h};
Point(2) = {0.4, 0, 0, h};
Point(3) = {0.4, 0.1, 0, h};
Point(4) = {0, 0.1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("beam") = {1};
Mesh.Algorithm = 6;
