#!/usr/bin/python3
"""Counts the pixels at which VTK shows the farther of two sheets, without any code of Fathom.

usage: xvfb-run -a /usr/bin/python3 count_wrong_surfaces.py [--write FOLDER]

Exercise 3 of the course has two oblique sheets, one 0.0001 behind the other along the view. Here the nearer one comes
first in the file, near is 0.001 and far 1000, and the image has 96x96 pixels. VTK draws them with its own depth
buffer, and with attachments of the types named. Cells are coloured with their numbers, without lighting, blending or
multisampling, in the pass that writes the depth. The sheets have the same outline, so the pixels that show a triangle of
the second sheet are counted. The corners are rounded to binary64, so at a few pixels of the outline (11 at distance 2)
the second sheet is the right answer.

The script prints a line for each distance and depth buffer: "2 own 2610". With --write FOLDER it draws nothing and writes
each scene as scene-DISTANCE.obj with its camera.json, for
`fathom validate FOLDER/scene-2.obj --camera FOLDER/camera.json --against vtk`.

Needs Debian's python3-vtk9 and, without a display, xvfb.
"""
import argparse
import json
import pathlib

import vtk
from vtk.util.numpy_support import vtk_to_numpy

SIZE, NEAR, FAR, APART = 96, 0.001, 1000.0, 0.0001
DISTANCES = (2, 10)
ATTACHMENTS = {"own": None, "unorm16": vtk.vtkTextureObject.Fixed16, "unorm24": vtk.vtkTextureObject.Fixed24,
               "unorm32": vtk.vtkTextureObject.Fixed32, "float32": vtk.vtkTextureObject.Float32}
TRIANGLES = ((0, 1, 2), (0, 2, 3), (4, 5, 6), (4, 6, 7))  # the nearer sheet first

# Xvfb starts anew when its last window closes, and refuses the next one meanwhile.
WINDOWS = []


def corners_of(distance):
    """The corners of both sheets: x right, y down, z forward, scene units."""
    side = distance / 3
    nearer = ((-side, -side, distance), (side, -side, distance * 1.2), (side, side, distance * 1.4),
              (-side, side, distance * 1.2))
    behind = tuple((x * (z + APART) / z, y * (z + APART) / z, z + APART) for x, y, z in nearer)
    return nearer + behind


def polygons_of(corners):
    """The triangles, each with its number in the red channel."""
    points, cells, colours = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkUnsignedCharArray()
    points.SetDataTypeToDouble()
    for x, y, z in corners:
        points.InsertNextPoint(x, -y, -z)  # to x right, y up, z backward
    colours.SetNumberOfComponents(3)
    for number, triangle in enumerate(TRIANGLES):
        cells.InsertNextCell(3, triangle)
        colours.InsertNextTuple3(number + 1, 0, 0)
    polygons = vtk.vtkPolyData()
    polygons.SetPoints(points)
    polygons.SetPolys(cells)
    polygons.GetCellData().SetScalars(colours)
    return polygons


def exchange_depth(window, attachment):
    depth = vtk.vtkTextureObject()
    depth.SetContext(window)
    depth.AllocateDepth(SIZE, SIZE, attachment)
    framebuffer = window.GetRenderFramebuffer()
    framebuffer.Bind()
    framebuffer.AddDepthAttachment(depth)
    framebuffer.UnBind()


def numbers_seen(corners, attachment):
    """The numbers of the visible triangles, from 1; 0 where the background is seen."""
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(polygons_of(corners))
    mapper.SetColorModeToDirectScalars()
    mapper.SetScalarModeToUseCellData()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0, 0, 0)
    camera.SetFocalPoint(0, 0, -1)
    camera.SetViewUp(0, 1, 0)
    projection = vtk.vtkMatrix4x4()  # OpenGL's, of a focal length of SIZE pixels
    projection.Zero()
    projection.SetElement(0, 0, 2)
    projection.SetElement(1, 1, 2)
    projection.SetElement(2, 2, -(FAR + NEAR) / (FAR - NEAR))
    projection.SetElement(2, 3, -2 * FAR * NEAR / (FAR - NEAR))
    projection.SetElement(3, 2, -1)
    camera.SetExplicitProjectionTransformMatrix(projection)
    camera.UseExplicitProjectionTransformMatrixOn()
    camera.SetClippingRange(NEAR, FAR)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(SIZE, SIZE)
    window.AddRenderer(renderer)
    window.Render()
    if attachment is not None:
        exchange_depth(window, attachment)  # of the framebuffer that the first frame made
        window.Render()
    WINDOWS.append(window)
    pixels = vtk.vtkUnsignedCharArray()
    window.GetPixelData(0, 0, SIZE - 1, SIZE - 1, 0, pixels, 0)
    return vtk_to_numpy(pixels)[:, 0]


def write_scene(folder, distance):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners_of(distance)]
    lines += ["f " + " ".join(str(corner + 1) for corner in triangle) for triangle in TRIANGLES]
    (folder / f"scene-{distance}.obj").write_text("\n".join(lines) + "\n")


def write_files(folder):
    folder.mkdir(parents=True, exist_ok=True)
    camera = {"width": SIZE, "height": SIZE, "fx": SIZE, "fy": SIZE, "cx": SIZE / 2, "cy": SIZE / 2,
              "pixel_centre": 0.5, "world_to_camera": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]],
              "near": NEAR, "far": FAR}
    (folder / "camera.json").write_text(json.dumps(camera) + "\n")
    for distance in DISTANCES:
        write_scene(folder, distance)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", type=pathlib.Path, metavar="FOLDER", help="write the scenes and their camera")
    arguments = parser.parse_args()
    if arguments.write:
        write_files(arguments.write)
        return
    for distance in DISTANCES:
        for name, attachment in ATTACHMENTS.items():
            print(distance, name, int((numbers_seen(corners_of(distance), attachment) > 2).sum()))


if __name__ == "__main__":
    main()
