// Cantilever, one corner at the origin. Lengths in metres.
DefineConstant[ size = 0.01 ];       // mesh size
DefineConstant[ length = 0.4 ];      // along x
DefineConstant[ height = 0.1 ];      // along y

Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};
Point(3) = {length, height, 0, size};
Point(4) = {0, height, 0, size};
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
