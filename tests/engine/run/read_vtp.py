"""read_vtp.py FILE.vtp...: prints what VTK itself reads from VTP files."""
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

ERRORS = []

for name in sys.argv[1:]:
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(name)
    reader.AddObserver("ErrorEvent", lambda *_: ERRORS.append(name))
    reader.Update()
    data = reader.GetOutput()
    time = data.GetFieldData().GetArray("TimeValue").GetValue(0)
    print("points", data.GetNumberOfPoints(), "verts", data.GetNumberOfVerts(), "time", time)
    for i in range(data.GetNumberOfPoints()):
        print("x", *data.GetPoint(i))
    for k in range(data.GetPointData().GetNumberOfArrays()):
        array = data.GetPointData().GetArray(k)
        rows = [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]
        if array.GetNumberOfComponents() == 1:
            rows = [array.GetValue(i) for i in range(array.GetNumberOfTuples())]
        print(array.GetName(), rows)
sys.exit(1 if ERRORS else 0)
