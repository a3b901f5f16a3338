// Cook's membrane, its lower left corner at the origin. Lengths in metres.
DefineConstant[ cells = 24 ];        // along each side

Point(1) = {0, 0, 0, 0.044 / cells};
Point(2) = {0.048, 0.044, 0, 0.032 / cells};
Point(3) = {0.048, 0.060, 0, 0.032 / cells};
Point(4) = {0, 0.044, 0, 0.044 / cells};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("left") = {4};
Physical Curve("right") = {2};
Physical Surface("membrane") = {1};
Mesh.Algorithm = 6;
