"""How bright a surface looks, by its direction: one light, the same for all that is drawn.

Colours and normals are those of a viewer: x to the right, y up, z towards the eye.
"""

import numpy as np


def _unit(*vector):
    return np.array(vector) / np.linalg.norm(vector)


SUN = _unit(-0.45, 0.70, 0.55)
AMBIENT, DIFFUSE = 0.60, 0.46
# The highlight: its strength, the power with which it falls off, and the normal that shines most:
# that of water that rises a little towards the light behind it.
GLOSS, SHARPNESS = 0.35, 40
HALF = _unit(-0.28, 0.85, 0.50)


def lit(colours, normals, gloss=0.0, openness=1.0):
    """Colours in the light, by Lambert's law and a highlight after Blinn.

    Parameters
    ----------
    colours : (n, 3) float64 [0 to 1]
    normals : (n, 3) float64 [-]
        Unit vectors.
    gloss : float [-]
        Strength of the highlight, in shares of white.
    openness : float or (n,) float64 [-]
        Share of the surrounding light that comes in; 0 in a closed hollow.

    Returns
    -------
    (n, 3) float64 [0 to 1]
    """
    openness = np.broadcast_to(openness, len(normals))
    bright = openness * (AMBIENT + DIFFUSE * np.maximum(normals @ SUN, 0.0))
    shine = gloss * openness * np.maximum(normals @ HALF, 0.0) ** SHARPNESS
    return np.clip(colours * bright[:, None] + shine[:, None], 0.0, 1.0)


def shader(gloss):
    """The same for a sphere, as a fragment shader of VTK's vtkPointGaussianMapper."""

    def vector(values):
        return "vec3({:.6f}, {:.6f}, {:.6f})".format(*values)

    return f"""//VTK::Color::Impl
    float across = dot(offsetVCVSOutput.xy, offsetVCVSOutput.xy);
    if (across > 1.0) discard;
    vec3 facing = vec3(offsetVCVSOutput.xy, sqrt(1.0 - across));
    float bright = {AMBIENT:.6f} + {DIFFUSE:.6f} * max(dot(facing, {vector(SUN)}), 0.0);
    float shine = {gloss:.6f} * pow(max(dot(facing, {vector(HALF)}), 0.0), {SHARPNESS:.1f});
    ambientColor = min(diffuseColor * bright + shine, 1.0);
    diffuseColor = vec3(0.0);
    """
