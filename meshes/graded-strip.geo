// Strip along x of three sections, one corner at the origin. Lengths in metres.
DefineConstant[ left = 0.06 ];         // lengths of the sections
DefineConstant[ middle = 0.04 ];
DefineConstant[ right = 0.03 ];
DefineConstant[ height = 0.024 ];
DefineConstant[ left_size = 0.004 ];   // their mesh sizes, largest first; a line between two of them has nodes of the size on its left
DefineConstant[ middle_size = 0.002 ];
DefineConstant[ right_size = 0.001 ];
DefineConstant[ growth = 0 ];          // above 0: behind the left section the size falls by this times the distance, down to right_size
DefineConstant[ regular = 0 ];         // number of sections, from the left, that are a regular grid
DefineConstant[ algorithm = 5 ];       // 5: Delaunay; 6: frontal

ends() = {0, left, left + middle, left + middle + right};
sizes() = {left_size, left_size, middle_size, right_size};
For i In {0:3}
  Point(1 + 2 * i) = {ends(i), 0, 0};
  Point(2 + 2 * i) = {ends(i), height, 0};
  Line(1 + i) = {1 + 2 * i, 2 + 2 * i};
  If (i < 2 || growth == 0)
    Transfinite Curve{1 + i} = Round(height / sizes(i)) + 1;
  EndIf
EndFor
For i In {0:2}
  Line(11 + i) = {1 + 2 * i, 3 + 2 * i};
  Line(21 + i) = {2 + 2 * i, 4 + 2 * i};
  Curve Loop(1 + i) = {11 + i, 2 + i, -(21 + i), -(1 + i)};
  Plane Surface(1 + i) = {1 + i};
  // The line on its left belongs to the section before.
  Field[1 + i] = Box;
  Field[1 + i].XMin = ends(i) + (i > 0 ? 1e-6 : 0);
  Field[1 + i].XMax = ends(i + 1);
  Field[1 + i].YMax = height;
  Field[1 + i].VIn = sizes(i + 1);
  Field[1 + i].VOut = 1;
  If (i < regular)
    Transfinite Surface{1 + i} Alternate;
  EndIf
  If (i == 0 || growth == 0)
    Transfinite Curve{11 + i, 21 + i} = Round((ends(i + 1) - ends(i)) / sizes(i + 1)) + 1;
  EndIf
EndFor

Physical Curve("left", 1) = {1};
Physical Curve("right", 2) = {4};
Physical Surface("strip", 3) = {1:3};

Field[4] = MathEval;
Field[4].F = Sprintf("Max(%g, Min(%g, %g - %g * (x - %g)))", right_size, left_size, left_size, growth, left);
Field[5] = Min;
Field[5].FieldsList = {1:3};
Background Field = growth > 0 ? 4 : 5;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm = algorithm;
Mesh.MshFileVersion = 4.1;
