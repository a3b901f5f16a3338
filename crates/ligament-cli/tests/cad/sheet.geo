SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 20, 10};
Rotate {{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{1}; }
