"""check_series.py RESULTS_DIR [PICTURE.png]

Reads a ParaView series back with VTK and holds it against results.nc, which xarray must be able to read whole: every cell is the exact rational cubic, every
field takes its samples. With PICTURE.png, renders all stored times into one picture and checks that it shows the beams.
Exits with 1, and says where, when something differs.
"""

import os
import sys
import xml.etree.ElementTree as ElementTree

import netCDF4
import numpy as np
import vtk
import xarray
from vtk.util.numpy_support import vtk_to_numpy

FIELDS = ["strain", "curvature", "axial_force", "bending_moment", "velocity"]


def fail(message):
    sys.exit(f"check_series: {message}")


def read_grid(file):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    if reader.GetErrorCode():
        fail(f"{file}: VTK cannot read it")
    return reader.GetOutput()


def series_of(directory):
    """{name: [(time, file)]} of frames.pvd, in order."""
    series = {}
    root = ElementTree.parse(os.path.join(directory, "frames.pvd")).getroot()
    for entry in root.iter("DataSet"):
        file = os.path.join(directory, entry.get("file"))
        series.setdefault(entry.get("name"), []).append((float(entry.get("timestep")), file))
    return series


def rational_cubic(points, u):
    bernstein = np.array([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u * u * (1 - u), u**3])
    weighted = bernstein @ points
    return weighted[:3] / weighted[3]


def evaluate(cell, u):
    """Position and interpolation weights of VTK's own cell at parameter u."""
    sub_id, position = vtk.reference(0), [0.0, 0.0, 0.0]
    weights = [0.0] * cell.GetNumberOfPoints()
    cell.EvaluateLocation(sub_id, [u, 0.0, 0.0], position, weights)
    return np.array(position), np.array(weights)


def near(found, expected, scale, what):
    difference = np.max(np.abs(np.asarray(found) - np.asarray(expected)))
    if not difference <= 1e-10 * scale:
        fail(f"{what}: differs by {difference}")


def check_frame(grid, store, first, count, where):
    if grid.GetNumberOfCells() != count:
        fail(f"{where}: {grid.GetNumberOfCells()} cells, but {count} elements")
    size = np.max(np.abs(store["control_points"][:, :, :3]))
    arrays = {name: vtk_to_numpy(grid.GetPointData().GetArray(name)) for name in FIELDS}
    scale = {name: np.max(np.abs(store[name][:])) + 1e-300 for name in FIELDS}
    for i in range(count):
        if grid.GetCellType(i) != vtk.VTK_BEZIER_CURVE:
            fail(f"{where}: cell {i} has type {grid.GetCellType(i)}")
        cell = grid.GetCell(i)
        ids = [cell.GetPointId(k) for k in range(4)]
        points = store["control_points"][first + i]
        for u in np.linspace(0, 1, 7):
            position, _ = evaluate(cell, u)
            near(position, rational_cubic(points, u), size, f"{where}: cell {i} at u = {u}")
        for k, u in enumerate([0, 1 / 3, 2 / 3, 1]):
            _, weights = evaluate(cell, u)
            for name in FIELDS:
                value = np.tensordot(weights, arrays[name][ids], axes=1)
                near(value, store[name][first + i, k], scale[name], f"{where}: {name} of cell {i} at u = {u}")


def check_bodies(grid, store, frame, where):
    positions = store["body_position"][frame]
    if grid.GetNumberOfCells() != len(positions):
        fail(f"{where}: {grid.GetNumberOfCells()} bodies, expected {len(positions)}")
    near(vtk_to_numpy(grid.GetPoints().GetData()), positions, 1, where)


def check_connectors(grid, store, frame, where):
    ends = np.stack([store["connector_from_position"][frame], store["connector_to_position"][frame]], axis=1)
    if grid.GetNumberOfCells() != len(ends) or any(grid.GetCellType(i) != vtk.VTK_LINE for i in range(len(ends))):
        fail(f"{where}: not the lines of {len(ends)} connectors")
    near(vtk_to_numpy(grid.GetPoints().GetData()), ends.reshape(-1, 3), 1, where)
    near(vtk_to_numpy(grid.GetCellData().GetArray("force")), store["connector_force"][frame], 1, where)


def render(grids, file):
    """All grids in one picture, tessellated by VTK, coloured by axial force."""
    forces = np.concatenate([vtk_to_numpy(grid.GetPointData().GetArray("axial_force")) for grid in grids])
    shown = np.percentile(forces, [2, 98])
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for grid in grids:
        tessellated = vtk.vtkDataSetSurfaceFilter()
        tessellated.SetInputData(grid)
        tessellated.SetNonlinearSubdivisionLevel(4)
        tubes = vtk.vtkTubeFilter()
        tubes.SetInputConnection(tessellated.GetOutputPort())
        tubes.SetRadius(0.004 * grid.GetLength())
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(tubes.GetOutputPort())
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("axial_force")
        mapper.SetScalarRange(*shown)
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        renderer.AddActor(actor)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1000, 500)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    bounds = renderer.ComputeVisiblePropBounds()
    flat = bounds[5] - bounds[4] < bounds[3] - bounds[2]
    camera.SetFocalPoint(0, 0, 0)
    camera.SetPosition(*((0, 0, 1) if flat else (0, -1, 0)))
    camera.SetViewUp(*((0, 1, 0) if flat else (0, 0, 1)))
    renderer.ResetCamera()
    camera.Zoom(1.7)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    pixels = vtk_to_numpy(image.GetOutput().GetPointData().GetScalars())
    inked = np.count_nonzero(np.any(pixels < 200, axis=1))
    if inked < 1000:
        fail(f"{file}: only {inked} pixels are not white")


def main(directory, picture=None):
    xarray.load_dataset(os.path.join(directory, "results.nc")).close()
    store = netCDF4.Dataset(os.path.join(directory, "results.nc"))
    times = store["time"][:]
    counts = store["element_count"][:].sum(axis=1)
    series = series_of(directory)
    beams = series["beams"]
    if [time for time, _ in beams] != list(times):
        fail("frames.pvd has not the times of results.nc")
    first, grids = 0, []
    for frame, (_, file) in enumerate(beams):
        grids.append(read_grid(file))
        check_frame(grids[-1], store, first, counts[frame], file)
        first += counts[frame]
    for frame, (_, file) in enumerate(series.get("bodies", [])):
        check_bodies(read_grid(file), store, frame, file)
    for frame, (_, file) in enumerate(series.get("connectors", [])):
        check_connectors(read_grid(file), store, frame, file)
    if "connector" in store.dimensions and len(series["connectors"]) != len(times):
        fail("frames.pvd lacks files of connectors")
    if "body" in store.dimensions and len(series["bodies"]) != len(times):
        fail("frames.pvd lacks files of bodies")
    if picture:
        render(grids, picture)
    print(f"{len(beams)} frames, {counts.min()} to {counts.max()} elements: as in results.nc")


main(*sys.argv[1:])
