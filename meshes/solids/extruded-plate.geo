// Plate with a round hole, one corner at the origin, and its extrusion along z; with `layers` = 0 the plate alone. Lengths in metres.
DefineConstant[ size = 0.06 ];       // mesh size
DefineConstant[ layers = 1 ];        // of prisms, each `size` thick
DefineConstant[ length = 2.0 ];      // along x
DefineConstant[ height = 1.0 ];      // along y
DefineConstant[ radius = 0.2 ];      // of the hole in the middle

x = length/2;
y = height/2;
Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};
Point(3) = {length, height, 0, size};
Point(4) = {0, height, 0, size};
Point(5) = {x, y, 0, size};
Point(6) = {x + radius, y, 0, size};
Point(7) = {x, y + radius, 0, size};
Point(8) = {x - radius, y, 0, size};
Point(9) = {x, y - radius, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 8};
Circle(7) = {8, 5, 9};
Circle(8) = {9, 5, 6};
Curve Loop(1) = {1:4};
Curve Loop(2) = {5:8};
Plane Surface(1) = {1, 2};

Mesh.Algorithm = 6;                  // Frontal-Delaunay
Mesh.MshFileVersion = 4.1;
If (layers > 0)
  solid() = Extrude {0, 0, layers*size} { Surface{1}; Layers{layers}; Recombine; };
  Physical Surface("left", 1) = {solid[5]};
  Physical Surface("right", 2) = {solid[3]};
  Physical Surface("bottom", 3) = {solid[2]};
  Physical Surface("faces", 4) = {1, solid[0]};
  Physical Volume("plate", 5) = {solid[1]};
Else
  Physical Curve("left", 1) = {4};
  Physical Curve("right", 2) = {2};
  Physical Curve("bottom", 3) = {1};
  Physical Surface("plate", 5) = {1};
EndIf
