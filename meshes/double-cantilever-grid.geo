// Double cantilever of regular cells, for a crack along the x axis that stays there (not meshed): nodes lie half a cell above and
// below it, in mirrored rows. Lengths in metres.
DefineConstant[ cells = 100 ];       // along the length
DefineConstant[ length = 50e-3 ];    // along x
DefineConstant[ half_height = 10e-3 ];

// An odd number of rows, nearly as high as the cells are long.
half_rows = Round(cells * half_height / length);
row = 2 * half_height / (2 * half_rows + 1);

Point(1) = {0, -half_height, 0};
Point(2) = {length, -half_height, 0};
Point(3) = {length, -0.5 * row, 0};
Point(4) = {0, -0.5 * row, 0};
Point(5) = {0, 0.5 * row, 0};
Point(6) = {length, 0.5 * row, 0};
Point(7) = {length, half_height, 0};
Point(8) = {0, half_height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {4, 5};
Line(6) = {5, 6};
Line(7) = {6, 3};
Line(8) = {6, 7};
Line(9) = {7, 8};
Line(10) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, -7, -6, -5};
Curve Loop(3) = {6, 8, 9, 10};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Transfinite Curve{1, 3, 6, 9} = cells + 1;
Transfinite Curve{2, 4, 8, 10} = half_rows + 1;
Transfinite Curve{5, 7} = 2;
Transfinite Surface{1} = {1, 2, 3, 4} Right;
Transfinite Surface{2} = {4, 3, 6, 5} Alternate;
Transfinite Surface{3} = {5, 6, 7, 8} Left;

Physical Point("corner", 1) = {2};
Physical Surface("beam", 2) = {1, 2, 3};
Mesh.MshFileVersion = 4.1;
