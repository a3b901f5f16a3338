// Square plate; its notch is a pre-crack of the case. Lengths in metres.
DefineConstant[ size = 2.5e-5 ];     // mesh size
DefineConstant[ side = 1e-3 ];
DefineConstant[ algorithm = 5 ];     // 5: Delaunay, 6: Frontal-Delaunay

Point(1) = {0, 0, 0, size};
Point(2) = {side, 0, 0, size};
Point(3) = {side, side, 0, size};
Point(4) = {0, side, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("bottom") = {1};
Physical Curve("top") = {3};
Physical Surface("plate") = {1};
Mesh.Algorithm = algorithm;
