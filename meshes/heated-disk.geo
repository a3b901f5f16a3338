// Disk centred at the origin with a concentric core of its own surface, and a field "heat" at the nodes: the change of
// temperature 100 (1 - r^2/radius^2) K.
// Parameters: -setnumber size 0.0025 -setnumber radius 0.05 -setnumber core 0.02 (m). Made by `gmsh - <arguments> heated-disk.geo`,
// which writes heated-disk.msh beside this file.
DefineConstant[ size = 0.0025, radius = 0.05, core = 0.02 ];

Point(1) = {0, 0, 0, size};
For ring In {0 : 1}
  r = ring ? core : radius;
  first = 10 * (ring + 1);
  Point(first) = {r, 0, 0, size};
  Point(first + 1) = {0, r, 0, size};
  Point(first + 2) = {-r, 0, 0, size};
  Point(first + 3) = {0, -r, 0, size};
  Circle(first) = {first, 1, first + 1};
  Circle(first + 1) = {first + 1, 1, first + 2};
  Circle(first + 2) = {first + 2, 1, first + 3};
  Circle(first + 3) = {first + 3, 1, first};
  Curve Loop(ring + 1) = {first, first + 1, first + 2, first + 3};
EndFor
Plane Surface(1) = {1, 2};
Plane Surface(2) = {2};

Physical Curve("rim") = {10, 11, 12, 13};
Physical Surface("shell") = {1};
Physical Surface("core") = {2};

Mesh.Algorithm = 5;
Mesh.MshFileVersion = 4.1;
Mesh 2;

Plugin(NewView).Run;
Plugin(ModifyComponents).View = 0;
Plugin(ModifyComponents).Expression0 = Sprintf("100*(1-(x*x+y*y)/%g)", radius * radius);
Plugin(ModifyComponents).Run;
View[0].Name = "heat";
Save View[0] "heated-disk.msh";
