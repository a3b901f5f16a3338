SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 10, 20, 30};
