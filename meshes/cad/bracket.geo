// An L-shaped bracket with a hole in its foot, lengths in mm: a CAD file of it is made by `gmsh bracket.geo -0 -o bracket.step`.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 20, 4};
Box(2) = {0, 0, 4, 4, 20, 26};
Cylinder(3) = {26, 10, 0, 0, 0, 4, 4};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
BooleanDifference(5) = { Volume{4}; Delete; }{ Volume{3}; Delete; };
