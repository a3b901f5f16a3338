// Rectangular plate, one corner at the origin. Lengths in metres.
DefineConstant[ size = 0.004 ];      // mesh size
DefineConstant[ length = 0.2 ];      // along x
DefineConstant[ height = 0.1 ];      // along y
DefineConstant[ algorithm = 6 ];     // 6: frontal; 5: Delaunay

Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};
Point(3) = {length, height, 0, size};
Point(4) = {0, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Physical Point("corner", 1) = {1};
Physical Curve("left", 2) = {4};
Physical Curve("right", 3) = {2};
Physical Curve("bottom", 4) = {1};
Physical Curve("top", 5) = {3};
Physical Surface("plate", 6) = {1};

Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
