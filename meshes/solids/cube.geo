// Cube, one corner at the origin. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.01 ];       // mesh size
DefineConstant[ edge = 0.06 ];

Box(1) = {0, 0, 0, edge, edge, edge};
MeshSize{:} = size;
Physical Surface("left", 1) = {1};   // at the ends of x
Physical Surface("right", 2) = {2};
Physical Surface("front", 3) = {3};  // of y
Physical Surface("back", 4) = {4};
Physical Surface("bottom", 5) = {5}; // of z
Physical Surface("top", 6) = {6};
Physical Volume("cube", 7) = {1};

Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
