#!/usr/bin/env python3
"""write_spheres_with_vtk.py DIR: the same 5000 spheres in every encoding that VTK writes, and as
expected.csv."""
import pathlib
import random
import sys

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import VTK_VERTEX, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkCommonExecutionModel import vtkTrivialProducer  # noqa: F401
from vtkmodules.vtkIOLegacy import vtkPolyDataWriter, vtkUnstructuredGridWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

folder = pathlib.Path(sys.argv[1])
chance = random.Random(1)
spheres = [tuple(chance.uniform(-5e-3, 5e-3) for _ in "xyz") + (chance.uniform(1e-4, 2e-4),)
           for _ in range(5000)]
(folder / "expected.csv").write_text(
    "x_m,y_m,z_m,radius_m\n" + "".join("%r,%r,%r,%r\n" % sphere for sphere in spheres))


def fill(data, name, factor):
    points = vtkPoints()
    points.SetDataTypeToDouble()
    size, mass, velocity = vtkDoubleArray(), vtkDoubleArray(), vtkDoubleArray()
    size.SetName(name)
    mass.SetName("mass")
    velocity.SetName("velocity")
    velocity.SetNumberOfComponents(3)
    for x, y, z, radius in spheres:
        points.InsertNextPoint(x, y, z)
        size.InsertNextValue(radius * factor)
        mass.InsertNextValue(1)
        velocity.InsertNextTuple3(0, 0, 0)
    data.SetPoints(points)
    data.Allocate(len(spheres))
    for i in range(len(spheres)):
        data.InsertNextCell(VTK_VERTEX, 1, [i])
    for array in (velocity, mass, size):
        data.GetPointData().AddArray(array)
    return data


def write(writer, data, name):
    writer.SetFileName(str(folder / name))
    writer.SetInputData(data)
    assert writer.Write() == 1, name


for ending, data, xml, legacy in (
        ("vtp", fill(vtkPolyData(), "Diameter", 2), vtkXMLPolyDataWriter, vtkPolyDataWriter),
        ("vtu", fill(vtkUnstructuredGrid(), "radius", 1), vtkXMLUnstructuredGridWriter,
         vtkUnstructuredGridWriter)):
    for mode in ("Ascii", "Binary", "Appended"):
        for compressor in ("None", "ZLib"):
            writer = xml()
            getattr(writer, "SetDataModeTo" + mode)()
            getattr(writer, "SetCompressorTypeTo" + compressor)()
            write(writer, data, "%s_%s.%s" % (mode, compressor, ending))
    writer = xml()
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetHeaderTypeToUInt64()
    writer.SetByteOrderToBigEndian()
    write(writer, data, "raw_big_endian." + ending)
    for version in (42, 51):
        writer = legacy()
        writer.SetFileVersion(version)
        if version == 51:
            writer.SetFileTypeToBinary()
        write(writer, data, "%d_%s.vtk" % (version, ending))
    writer = legacy()
    write(writer, data, "ascii_%s.vtk" % ending)
