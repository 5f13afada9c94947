"""Reads the files of write_samples with VTK's own reader and compares every number, bit for bit.

Use: read_samples.py WRITE_SAMPLES, the compiled program beside this script.
"""
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from vtkmodules.vtkCommonCore import vtkLogger
from vtkmodules.vtkCommonDataModel import VTK_POLYGON, VTK_TRIANGLE, VTK_VERTEX
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader


def read_grid(path):
    """The grid of a file; any complaint of VTK is an error."""
    complaints = []
    reader = vtkXMLUnstructuredGridReader()
    for event in ("ErrorEvent", "WarningEvent"):
        reader.AddObserver(event, lambda caller, name: complaints.append(name))
    reader.SetFileName(str(path))
    reader.Update()
    if complaints or reader.GetErrorCode():
        raise RuntimeError(f"VTK cannot read {path}: {complaints}, code {reader.GetErrorCode()}")
    return reader.GetOutput()


def tuples(array):
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


def bits(rows):
    """Exact values, so that -0.0 differs from 0.0 and nothing is rounded."""
    return [[struct.pack("<d", value) for value in row] for row in rows]


def arrays(data):
    return {data.GetArrayName(i): data.GetArray(i) for i in range(data.GetNumberOfArrays())}


class Samples(unittest.TestCase):
    folder = pathlib.Path()

    def grid(self, name):
        return read_grid(self.folder / "frames" / name)

    def assert_rows(self, array, rows):
        self.assertEqual(bits(tuples(array)), bits(rows))

    def test_points_and_cells(self):
        grid = self.grid("mixed.vtu")
        self.assertEqual(grid.GetPoints().GetData().GetDataTypeAsString(), "double")
        self.assert_rows(grid.GetPoints().GetData(), [(i + 0.1, -2.0 * i, i / 3.0) for i in range(8)])
        cells = []
        for index in range(grid.GetNumberOfCells()):
            cell = grid.GetCell(index)
            points = [cell.GetPointId(i) for i in range(cell.GetNumberOfPoints())]
            cells.append((grid.GetCellType(index), points))
        self.assertEqual(cells, [(VTK_TRIANGLE, [0, 1, 2]), (VTK_TRIANGLE, [2, 1, 3]),
                                 (VTK_POLYGON, [1, 3, 4, 5, 6]), (VTK_VERTEX, [7])])

    def test_point_data(self):
        data = arrays(self.grid("mixed.vtu").GetPointData())
        self.assertEqual(set(data), {"displacement", "stress", "gradient"})
        self.assert_rows(data["displacement"],
                         [[math.sqrt(i + 10.0 * k) for k in range(3)] for i in range(8)])
        self.assert_rows(data["stress"], [[1e6 * i - k / 7.0 for k in range(6)] for i in range(8)])
        self.assert_rows(data["gradient"], [[100.0 * i + k for k in range(9)] for i in range(8)])

    def test_component_names(self):
        data = arrays(self.grid("mixed.vtu").GetPointData())
        names = {name: [array.GetComponentName(i) for i in range(array.GetNumberOfComponents())]
                 for name, array in data.items()}
        self.assertEqual(names["displacement"], ["x", "y", "z"])
        self.assertEqual(names["stress"], ["xx", "yy", "zz", "xy", "yz", "xz"])
        self.assertEqual(names["gradient"], [None] * 9)

    def test_cell_data(self):
        data = arrays(self.grid("mixed.vtu").GetCellData())
        self.assertEqual(set(data), {'a < b & "c"', "block"})
        self.assert_rows(data['a < b & "c"'], [[-0.0], [5e-324], [math.inf], [0.1 + 0.2]])
        self.assertEqual(data["block"].GetDataTypeAsString(), "int")
        self.assertEqual(tuples(data["block"]), [(-1.0,), (0.0,), (2147483647.0,), (-2147483648.0,)])

    def test_empty_grid(self):
        grid = self.grid("empty.vtu")
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (0, 0))
        force = arrays(grid.GetPointData())["force"]
        self.assertEqual((force.GetNumberOfComponents(), force.GetNumberOfTuples()), (3, 0))
        self.assertEqual(arrays(grid.GetCellData())["state"].GetNumberOfTuples(), 0)

    def test_several_compressed_blocks(self):
        for count in (4096, 4097):
            with self.subTest(count=count):
                grid = self.grid(f"points_{count}.vtu")
                self.assertEqual(grid.GetNumberOfCells(), count)
                self.assert_rows(grid.GetPoints().GetData(),
                                 [(i, math.sin(i), 1.0 / (i + 1)) for i in range(count)])
                self.assert_rows(arrays(grid.GetPointData())["value"],
                                 [[math.sqrt(i)] for i in range(count)])

    def test_a_damaged_file_is_noticed(self):
        whole = (self.folder / "frames/mixed.vtu").read_bytes()
        damaged = self.folder / "damaged.vtu"
        # Behind the block count, the two block sizes and the compressed size of the only block.
        start = whole.index(b"\n_") + 2 + 4 * 8
        damaged.write_bytes(whole[:start] + b"\xff" * 16 + whole[start + 16:])
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        with self.assertRaises(RuntimeError):
            read_grid(damaged)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)

    def test_series(self):
        root = ElementTree.parse(self.folder / "samples.pvd").getroot()
        self.assertEqual((root.tag, root.get("type")), ("VTKFile", "Collection"))
        frames = [(float(item.get("timestep")), item.get("file")) for item in root.iter("DataSet")]
        self.assertEqual(frames, [(0.0, "frames/empty.vtu"), (0.1 + 0.2, "frames/mixed.vtu")])
        for _, name in frames:
            read_grid(self.folder / name)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.argv.pop(1), folder], check=True)
        Samples.folder = pathlib.Path(folder)
        unittest.main(verbosity=2)
