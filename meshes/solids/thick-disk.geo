// Disk of the Brazilian test with its thickness, axis along z, centred at the origin, loaded along y. Lengths in m.
SetFactory("OpenCASCADE");
DefineConstant[ size = 0.004, diameter = 0.05, thickness = 0.025, platen = 0.0035 ];

radius = diameter/2;
Cylinder(1) = {0, 0, -thickness/2, 0, 0, thickness, radius};
// The platens: strips of the mantle within -platen <= x <= platen.
h = Sqrt(radius*radius - platen*platen);
Point(101) = { platen,  h, -thickness/2}; Point(102) = { platen,  h, thickness/2}; Line(101) = {101, 102};
Point(103) = {-platen,  h, -thickness/2}; Point(104) = {-platen,  h, thickness/2}; Line(102) = {103, 104};
Point(105) = { platen, -h, -thickness/2}; Point(106) = { platen, -h, thickness/2}; Line(103) = {105, 106};
Point(107) = {-platen, -h, -thickness/2}; Point(108) = {-platen, -h, thickness/2}; Line(104) = {107, 108};
BooleanFragments{ Volume{1}; Delete; }{ Line{101:104}; Delete; }
eps = size/100;
top() = Surface In BoundingBox{-platen - eps, h - eps, -thickness, platen + eps, radius + eps, thickness};
bottom() = Surface In BoundingBox{-platen - eps, -radius - eps, -thickness, platen + eps, -h + eps, thickness};
Physical Surface("platen-top") = {top()};
Physical Surface("platen-bottom") = {bottom()};
Physical Volume("disk") = {1};

Mesh.MeshSizeMin = size;
Mesh.MeshSizeMax = size;
Mesh.MshFileVersion = 4.1;
