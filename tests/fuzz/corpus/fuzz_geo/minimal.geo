LSMGeometry 1.2
BoundingBox 0 0 0 3 3 3
PeriodicBoundaries 0 1 0
Dimension 3D
BeginParticles
Simple
2
1 1 1 0.5 5 1
2 1 1 0.5 3 1
EndParticles
BeginConnect
1
3 5 1
EndConnect
