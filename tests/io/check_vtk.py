#!/usr/bin/env python3
"""Reads a particle file with VTK's own reader and compares it, bit for bit, with the PLY file of the same particles.

    check_vtk.py PARTICLES.vtk PARTICLES.ply TIME

Exit 0: all the same; 1: they differ; 77: this machine has no VTK for Python (Debian: python3-vtk9).
"""
import os
import struct
import sys

try:
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
except ImportError:
    # The distribution's package serves the distribution's Python, which need not be the first in PATH.
    system_python = "/usr/bin/python3"
    if "CURLEW_CHECK_VTK" not in os.environ and os.path.exists(system_python):
        os.environ["CURLEW_CHECK_VTK"] = "second try"
        os.execv(system_python, [system_python] + sys.argv)
    print("check_vtk.py: skipped, VTK for Python is missing (Debian: apt-get install python3-vtk9)")
    sys.exit(77)


def fail(sentence):
    print("check_vtk.py:", sentence)
    sys.exit(1)


def read_ply(path):
    """The properties of the vertices, by name."""
    with open(path, "rb") as file:
        head, body = file.read().split(b"end_header\n", 1)
    words = [line.split() for line in head.decode().splitlines()]
    names = [line[2] for line in words if line[0] == "property"]
    record = "<" + "".join({"float": "f", "uint": "I"}[line[1]] for line in words if line[0] == "property")
    count = next(int(line[2]) for line in words if line[:2] == ["element", "vertex"])
    if len(body) != count * struct.calcsize(record):
        fail(f"{path} has {len(body)} bytes of data, its header says {count} records {record}")
    columns = list(zip(*struct.iter_unpack(record, body))) or [()] * len(names)
    return count, dict(zip(names, columns))


def main():
    vtk_path, ply_path, time = sys.argv[1], sys.argv[2], float(sys.argv[3])
    count, ply = read_ply(ply_path)

    reader = vtkPolyDataReader()
    reader.SetFileName(vtk_path)
    reader.ReadAllScalarsOn()
    reader.ReadAllVectorsOn()
    errors = []
    reader.AddObserver("ErrorEvent", lambda *what: errors.append(what))
    reader.Update()
    if errors:
        fail("VTK's reader complained")
    data = reader.GetOutput()

    for what, found in (("points", data.GetNumberOfPoints()), ("vertices", data.GetNumberOfVerts())):
        if found != count:
            fail(f"{found} {what} instead of {count}")
    for cell in range(count):
        if data.GetCell(cell).GetPointId(0) != cell:
            fail(f"vertex {cell} shows point {data.GetCell(cell).GetPointId(0)}")
    found_time = data.GetFieldData().GetArray("TIME").GetValue(0)
    if found_time != time:
        fail(f"TIME is {found_time} instead of {time}")

    names = {"velocity": ["vx", "vy", "vz"]}
    arrays = data.GetPointData()
    compared = ["x", "y", "z"]
    for point in range(count):
        if data.GetPoint(point) != tuple(ply[axis][point] for axis in "xyz"):
            fail(f"point {point} is at {data.GetPoint(point)}")
    for index in range(arrays.GetNumberOfArrays() if count else 0):
        array = arrays.GetArray(index)
        name = array.GetName()
        columns = names.get(name, [name] if array.GetNumberOfComponents() == 1 else [f"{name}_{axis}" for axis in "xyz"])
        compared += columns
        for point in range(count):
            if array.GetTuple(point) != tuple(ply[column][point] for column in columns):
                fail(f"{name} of point {point} is {array.GetTuple(point)}")
    if count and sorted(compared) != sorted(ply):
        fail(f"the VTK file has {sorted(compared)}, the PLY file {sorted(ply)}")
    print(f"check_vtk.py: {count} points, {', '.join(compared)}: the same")


main()
