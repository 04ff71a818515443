# pvpython in_paraview.py FILE.pvd: opens a sequence, goes to its last time, and prints what is there.
import json
import sys

from paraview import simple, servermanager
from paraview.vtk.util.numpy_support import vtk_to_numpy

reader = simple.OpenDataFile(sys.argv[1])
reader.UpdatePipelineInformation()
times = list(reader.TimestepValues)
reader.UpdatePipeline(times[-1])
data = servermanager.Fetch(reader)
if data.IsA("vtkMultiBlockDataSet"):
    data = data.GetBlock(0)
bounds = data.GetBounds()
measured = simple.IntegrateVariables(Input=reader)
measured.UpdatePipeline(times[-1])
values = data.GetPointData()
print("\nFOUND\n" + json.dumps({
    "times": times,
    "low": bounds[0::2],
    "high": bounds[1::2],
    "area": servermanager.Fetch(measured).GetCellData().GetArray("Area").GetValue(0),
    "arrays": {values.GetArrayName(i): vtk_to_numpy(values.GetArray(i)).tolist() for i in range(values.GetNumberOfArrays())},
}))
