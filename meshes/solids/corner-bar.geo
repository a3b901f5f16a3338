// An upright bar of 20 x 20 x 40 mm, a corner at the origin. Lengths in metres.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.003 ];      // mesh size
Box(1) = {0, 0, 0, 0.02, 0.02, 0.04};
e = size/100;
Physical Surface("bottom") = Surface In BoundingBox{-e, -e, -e, 0.02 + e, 0.02 + e, e};
Physical Surface("top") = Surface In BoundingBox{-e, -e, 0.04 - e, 0.02 + e, 0.02 + e, 0.04 + e};
Physical Volume("bar") = {1};
Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
