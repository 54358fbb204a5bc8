"""Draws with VTK, off screen; it needs neither a graphics card nor an X server."""

import numpy as np
import pyvista
import vtk

from mpslab.analysis.scenes.light import shader

MULTISAMPLES = 8


def render(scene):
    """Draw a scene; see `mpslab.analysis.scenes.renderers`."""
    with _silence():
        plotter = pyvista.Plotter(off_screen=True, window_size=list(scene.view.size))
        try:
            plotter.set_background("white")
            plotter.enable_anti_aliasing("msaa", multi_samples=MULTISAMPLES)
            _add_quads(plotter, scene.quads)
            _add_surface(plotter, scene)
            _add_spheres(plotter, scene)
            _look(plotter.camera, scene.view)
            plotter.renderer.ResetCameraClippingRange()
            return np.ascontiguousarray(plotter.screenshot(return_img=True)[:, :, :3])
        finally:
            plotter.close()


class _silence:
    """Keeps VTK quiet, which says on stderr that there is no X server and does without."""

    def __enter__(self):
        self.earlier = vtk.vtkLogger.GetCurrentVerbosityCutoff()
        vtk.vtkLogger.SetStderrVerbosity(vtk.vtkLogger.VERBOSITY_OFF)

    def __exit__(self, *error):
        vtk.vtkLogger.SetStderrVerbosity(self.earlier)


def _add_quads(plotter, quads):
    if quads:
        corners = np.concatenate([corners for corners, _ in quads])
        faces = np.arange(len(corners)).reshape(-1, 4)
        mesh = pyvista.PolyData.from_regular_faces(corners, faces)
        mesh.cell_data["colour"] = _bytes(np.array([colour for _, colour in quads]))
        plotter.add_mesh(mesh, scalars="colour", rgb=True, lighting=False)


def _add_surface(plotter, scene):
    if len(scene.triangles):
        mesh = pyvista.PolyData.from_regular_faces(scene.points, scene.triangles)
        mesh.point_data["colour"] = _bytes(scene.point_colours)
        plotter.add_mesh(mesh, scalars="colour", rgb=True, lighting=False)


def _add_spheres(plotter, scene):
    """Spheres: each is a square that faces the eye, on which a shader draws a sphere."""
    if not len(scene.spheres):
        return
    cloud = pyvista.PolyData(scene.spheres)
    cloud.point_data["colour"] = _bytes(scene.sphere_colours)
    mapper = vtk.vtkPointGaussianMapper()
    mapper.SetInputData(cloud)
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("colour")
    mapper.SetColorModeToDirectScalars()
    mapper.EmissiveOff()
    mapper.SetScaleFactor(scene.radius)
    if hasattr(mapper, "SetBoundScale"):  # else the square is three times as wide as the sphere
        mapper.SetBoundScale(1.02)
    mapper.SetSplatShaderCode(shader(scene.gloss))
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    plotter.renderer.AddActor(actor)


def _look(camera, view):
    """Put VTK's camera where the eye is."""
    camera.position = view.eye
    camera.focal_point = view.eye + view.axes[2]
    camera.up = view.axes[1]
    camera.parallel_projection = view.parallel
    camera.parallel_scale = 0.5 * view.height
    camera.view_angle = 2.0 * np.degrees(np.arctan(view.slopes[1]))


def _bytes(colours):
    return np.round(255.0 * np.clip(colours, 0.0, 1.0)).astype(np.uint8)
