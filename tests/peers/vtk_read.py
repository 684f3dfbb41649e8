# SPDX-License-Identifier: GPL-3.0-or-later
# Reads pack.vtp with VTK's own reader.
import vtk

reader = vtk.vtkXMLPolyDataReader()
reader.SetFileName("pack.vtp")
reader.Update()
data = reader.GetOutput()
radius = data.GetPointData().GetArray("radius")
count = data.GetNumberOfPoints()
assert reader.GetErrorCode() == 0 and data.GetNumberOfVerts() == count
print("FOUND", count, repr(sum(radius.GetValue(i) for i in range(count))),
      repr(sum(data.GetPoint(i)[0] for i in range(count))))
