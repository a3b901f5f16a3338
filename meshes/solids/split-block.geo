// Block centred at the origin, to be split along the plane y = 0 (not meshed). Lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.005, length = 0.06, height = 0.06, width = 0.03 ];

Box(1) = {-length/2, -height/2, -width/2, length, height, width};
eps = size/100;
bottom() = Surface In BoundingBox{-length, -height/2 - eps, -width, length, -height/2 + eps, width};
top() = Surface In BoundingBox{-length, height/2 - eps, -width, length, height/2 + eps, width};

Physical Surface("bottom") = {bottom()};
Physical Surface("top") = {top()};
Physical Volume("block") = {1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
