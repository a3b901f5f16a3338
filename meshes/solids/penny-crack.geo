// Block centred at the origin, finer about a round crack in the plane z = 0 (not meshed). Lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[ fine = 0.0025, coarse = 0.01, side = 0.1, height = 0.1, reach = 0.013, half = 0.005, growth = 0.03 ];

Box(1) = {-side/2, -side/2, -height/2, side, side, height};
eps = fine/100;
bottom() = Surface In BoundingBox{-side, -side, -height/2 - eps, side, side, -height/2 + eps};
top() = Surface In BoundingBox{-side, -side, height/2 - eps, side, side, height/2 + eps};

Physical Surface("bottom") = {bottom()};
Physical Surface("top") = {top()};
Physical Volume("block") = {1};

Field[1] = Cylinder;
Field[1].Radius = reach;
Field[1].ZAxis = half;
Field[1].VIn = fine;
Field[1].VOut = coarse;
Field[2] = Box;
Field[2].XMin = -reach; Field[2].XMax = reach;
Field[2].YMin = -reach; Field[2].YMax = reach;
Field[2].ZMin = -half; Field[2].ZMax = half;
Field[2].Thickness = growth;
Field[2].VIn = fine;
Field[2].VOut = coarse;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMin = fine;
Mesh.MeshSizeMax = coarse;
Mesh.MshFileVersion = 4.1;
