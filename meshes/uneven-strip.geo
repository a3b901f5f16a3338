// Strip of 96 x 24 mm whose left end has 6 edges and whose right end has 7: what a mesher leaves of two equal sides. Lengths in metres.
DefineConstant[ length = 0.096 ];
DefineConstant[ height = 0.024 ];

Point(1) = {0, -height / 2, 0, height / 6};
Point(2) = {length, -height / 2, 0, height / 7};
Point(3) = {length, height / 2, 0, height / 7};
Point(4) = {0, height / 2, 0, height / 6};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve {4} = 7;
Transfinite Curve {2} = 8;

Physical Curve("left", 1) = {4};
Physical Curve("right", 2) = {2};
Physical Curve("top", 3) = {3};
Physical Curve("bottom", 4) = {1};
Physical Surface("strip", 5) = {1};

Mesh.Algorithm = 5;
Mesh.MshFileVersion = 4.1;
