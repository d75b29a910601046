// A bearing bracket, in millimetres: base plate with two bolt holes, upright with a bored and filleted boss, 45-degree
// gusset. scripts/make_demo_mesh makes bracket.mesh of it.
SetFactory("OpenCASCADE");

// Base plate with rounded front corners.
Box(1) = {-40, 0, 0, 80, 46, 10};
Box(2) = {-30, 46, 0, 60, 10, 10};
Cylinder(3) = {-30, 46, 0, 0, 0, 10, 10};
Cylinder(4) = {30, 46, 0, 0, 0, 10, 10};

// Upright with a round top, and the boss on its front.
Box(5) = {-22, 0, 0, 44, 12, 54};
Cylinder(6) = {0, 0, 54, 0, 12, 0, 22};
Cylinder(7) = {0, 0, 54, 0, 24, 0, 16};

// Gusset: a triangle in the plane x = -4, extruded.
Point(1001) = {-4, 10, 8};
Point(1002) = {-4, 36, 8};
Point(1003) = {-4, 10, 34};
Line(1001) = {1001, 1002};
Line(1002) = {1002, 1003};
Line(1003) = {1003, 1001};
Curve Loop(1001) = {1001, 1002, 1003};
Plane Surface(1001) = {1001};
gusset[] = Extrude {8, 0, 0} { Surface{1001}; };

BooleanUnion(20) = { Volume{1}; Delete; }{ Volume{2:7, gusset[1]}; Delete; };

// Bore of the boss and bolt holes.
Cylinder(21) = {0, -1, 54, 0, 26, 0, 10};
Cylinder(22) = {-27, 34, -1, 0, 0, 12, 5};
Cylinder(23) = {27, 34, -1, 0, 0, 12, 5};
BooleanDifference(30) = { Volume{20}; Delete; }{ Volume{21:23}; Delete; };

// Fillet where the boss meets the upright: the circle of radius 16 in the plane y = 12.
root[] = Curve In BoundingBox {-16.1, 11.9, 37.9, 16.1, 12.1, 70.1};
body[] = Fillet{30}{root[]}{3};

Physical Volume(1) = {body[]};

Mesh.MeshSizeMin = 1.5;
Mesh.MeshSizeMax = 3.3;
Mesh.MeshSizeFromCurvature = 16;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.SaveElementTagType = 2;
