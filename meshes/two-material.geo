// Bar of two halves that share the nodes of their interface. Lengths in metres.
DefineConstant[ size = 0.005 ];      // mesh size
DefineConstant[ length = 0.1 ];      // along x, the interface at half of it
DefineConstant[ height = 0.05 ];     // along y

Point(1) = {0, 0, 0, size};
Point(2) = {length / 2, 0, 0, size};
Point(3) = {length, 0, 0, size};
Point(4) = {length, height, 0, size};
Point(5) = {length / 2, height, 0, size};
Point(6) = {0, height, 0, size};
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

Physical Curve("left", 1) = {6};
Physical Curve("right", 2) = {3};
Physical Surface("left-half", 3) = {1};
Physical Surface("right-half", 4) = {2};

Mesh.Algorithm = 6;                  // Frontal-Delaunay
Mesh.MshFileVersion = 4.1;
