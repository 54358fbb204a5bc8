"""Makes the files of this case anew: the plates that water leans on, and the box as STL.

    python -m validation.structures.make
"""

import struct
from pathlib import Path

import numpy as np

FOLDER = Path(__file__).parent
SPACING, LEVEL, THICK = 0.01, 0.2, 0.0401  # [m]
FOOT = 0.2  # x of the foot of a plate [m]
ANGLES = (0, 15, 30, 45, 60, 75, 90)  # of the plates [deg]


def plate(angle):
    """Case of a tank with a plate at an angle, and 20 layers of water on its upper side."""
    if angle == 0:
        length, corners = 0.4, [[-0.1, 0.1], [0.5, 0.1], [0.5, 0.14], [-0.1, 0.14]]
        water = [f"[[water]]\nfrom = [0.0, 0.0, 0.14]\nto = [{length}, 0.0, 0.34]\n"]
    else:
        turn = np.radians(angle)
        along = np.array([np.cos(turn), np.sin(turn)])
        below = np.array([along[1], -along[0]])
        foot, top = np.array([FOOT, 0.0]) - 0.1 * along, (LEVEL + 0.1) / np.sin(turn)
        head = foot + (top + 0.1) * along
        corners = [foot, head, head + THICK * below, foot + THICK * below]
        length = np.ceil(20.0 * (head[0] + 0.1)) / 20.0
        water = ["[[water]]\nfrom = [0.0, 0.0, 0.0]\n" f"to = [{FOOT}, 0.0, {LEVEL}]\n"]
        for k in range(round((LEVEL / np.tan(turn)) / SPACING) if angle < 90 else 0):
            x = FOOT + k * SPACING
            low = (k + 0.5) * SPACING * np.tan(turn)
            if low <= LEVEL - 1.05 * SPACING:
                water.append(f"[[water]]\nfrom = [{x:.3f}, 0.0, {low:.4f}]\n"
                             f"to = [{x + SPACING:.3f}, 0.0, {LEVEL}]\n")  # fmt: skip
    points = ", ".join(f"[{x:.5f}, {z:.5f}]" for x, z in corners)
    return (
        f'# Made by make.py.\nname = "plate_{angle}"\n'
        f'title = "Water on a plate at {angle} degrees"\n'
        f"\n[tank]\nlength = {length:.3f}\ndepth = {LEVEL}\nheight = 0.45\n"
        '\n[wavemaker]\ntype = "none"\n'
        f"\n[particles]\nspacing = {SPACING}\njitter = 0.02\n"
        "\n[time]\nend = 10.0\n\n[output]\ninterval = 0.1\n\n"
        + "\n".join(water)
        + f'\n[[solid]]\nname = "plate"\nshape = "polygon"\npoints = [{points}]\n'
    )


def box():
    """A cube of edge 1 about the origin as binary STL."""
    corner = np.array(np.meshgrid(*[[-0.5, 0.5]] * 3, indexing="ij")).reshape(3, -1).T
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    content = b"cube of edge 1".ljust(80) + struct.pack("<I", len(triangles))
    for triangle in triangles:
        a, b, c = corner[list(triangle)]
        normal = np.cross(b - a, c - a)
        content += struct.pack("<12fH", *normal, *a, *b, *c, 0)
    return content


if __name__ == "__main__":
    for angle in ANGLES:
        (FOLDER / f"plate-{angle}.toml").write_text(plate(angle))
    (FOLDER / "cube.stl").write_bytes(box())
