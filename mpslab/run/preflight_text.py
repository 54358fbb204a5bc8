"""The findings of a preflight in words, from its numbers alone."""

from mpslab.theory import breaking

LIMIT = f"H L^2/h^3 < {breaking.MADSEN_URSELL_LIMIT:.3g}"


def sections(found):
    """Lines under headings.

    Parameters
    ----------
    found : dict
        `mpslab.run.preflight.Preflight.findings`, or "preflight" of a ``run.json``.

    Returns
    -------
    dict of str to list of (str, str)
        Name and value of each line, by the heading that it stands under.
    """
    told = {
        "Particles": [*_particles(found)],
        "Cost (one core, rough)": [*_cost(found)],
        "Results (rough)": [*_results(found)],
    }
    maker = found.get("wavemaker", {"stroke [m]": 0.0})
    if maker["stroke [m]"] > 0.0 or "absorption" in maker:
        told["Wavemaker"] = [*_wavemaker(maker)]
    if "tank_motion" in found:
        told["Motion of the tank"] = [*_tank_motion(found["tank_motion"])]
    for name, body in found.get("bodies", {}).items():
        told[f"Free body {name}"] = [*_body(body, found["spacing [m]"])]
    if "sponges" in found:
        told["Sponges"] = [*_sponges(found["sponges"])]
    if "wave" in found:
        told["Wave"] = [*_wave(found["wave"], found["spacing [m]"])]
    return told


def _particles(found):
    counts, spacing = found["particles"], found["spacing [m]"]
    kinds = ", ".join(f"{n:,} {name}" for name, n in counts.items() if n)
    yield "particles", f"{sum(counts.values()):,} ({kinds})"
    yield "spacing", f"{spacing * 1e3:g} mm, {found['spacings_over_depth']:.3g} over the depth"
    width = f", {found['tank_width [m]']:.4g} m wide" if found["tank_width [m]"] else ""
    yield "tank in whole spacings", f"{found['tank_length [m]']:.4g} m long{width}"
    for name, faces in found["laid_out"].items():
        sides = [_side(axis[0], *places) for axis, places in faces.items()]
        yield f"{name} in whole spacings", ", ".join(sides)
    for name, solid in found["solids"].items():
        yield name, _solid(solid, spacing)
    if "waters" in found:
        unit = "m3" if found["tank_width [m]"] else "m2"
        sizes = ", ".join(f"{size:.3g} {unit}" for size in found["waters"])
        yield "bodies of water", f"{len(found['waters'])}, of {sizes}, that solids keep apart"


def _solid(solid, spacing):
    """What a solid covers, and how thin it is."""
    sides = [_side(axis[0], *ends) for axis, ends in solid.items() if axis[1:] == " [m]"]
    thin = solid["thinnest [m]"]
    across = f", {thin / spacing:.3g} spacings at the thinnest" if thin else ""
    of = f", {solid['volume [m3]']:.4g} m3" if "volume [m3]" in solid else ""
    of = f", {solid['area [m2]']:.4g} m2" if "area [m2]" in solid else of
    mended = f" ({'; '.join(solid['mended'])})" if "mended" in solid else ""
    return f"{solid['shape']}, {', '.join(sides)}{of}{across}{mended}"


def _body(body, spacing):
    """How heavy a free body is, how it floats, and what is near it."""
    yield "mass", f"{body['mass [kg]']:.4g} kg, {body['density [kg/m3]']:.4g} kg/m3"
    inertia = ", ".join(f"{number:.4g}" for number in body["inertia [kg m2]"])
    yield "moment of inertia", f"{inertia} kg m2"
    if "draft [m]" in body:
        yield "draft afloat", _mm(body["draft [m]"])
        yield "centre of mass afloat", f"z = {body['floats_at [m]']:.4g} m"
        yield "metacentric height", _mm(body["metacentric_height [m]"])
    else:
        yield "draft afloat", "none: it sinks"
    gap = body["smallest_gap [m]"]
    yield "smallest gap", f"{_mm(gap)}, {gap / spacing:.3g} spacings, to the {body['nearest']}"


def _side(axis, low, high):
    top = "top" if high is None and axis == "z" else _face(high, axis)
    return f"{axis} {_face(low, axis)} to {top}"


def _face(place, axis):
    if place is not None:
        return f"{place:.4g} m"
    return "bed" if axis == "z" else "wall"


def _cost(found):
    yield "expected time step", f"{found['time_step [s]']:.2g} s"
    yield "limit of the time step", found["time_step_limit"]
    yield "expected steps", f"{found['steps']:,} to t = {found['end [s]']:g} s"
    yield "expected run time", _duration(found["run_time [s]"])
    yield "expected memory", f"{found['memory [B]'] / 1e6:,.0f} MB"


def _duration(seconds):
    if seconds < 120.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 7200.0 else f"{seconds / 3600:.1f} h"


def _results(found):
    frames, size = found["frames"], found["frame [B]"]
    yield "frames", f"{frames:,} of {_bytes(size)}, {_bytes(frames * size)}"
    rows = f"{found['steps']:,} rows of steps, {found['readings']:,} of gauges"
    yield "tables", f"{rows}, {_bytes(found['tables [B]'])}"


def _bytes(number):
    for unit, size in (("GB", 1e9), ("MB", 1e6)):
        if number >= size:
            return f"{number / size:,.1f} {unit}"
    return f"{number / 1e3:.0f} kB"


def _wavemaker(maker):
    yield "type", maker["type"]
    yield "stroke", _mm(maker["stroke [m]"])
    yield "theory", maker["theory"]
    if "rows" in maker:
        begin, end = maker["begin [s]"], maker["end [s]"]
        yield "record", f"{maker['rows']} rows, t = {begin:g} s to {end:g} s of the run"
    yield from _sea(maker)
    if "top_speed [m/s]" in maker:
        yield "top speed", f"{maker['top_speed [m/s]']:.3g} m/s"
        yield "largest acceleration", f"{maker['largest_acceleration [m/s2]']:.3g} m/s2"
    if "absorption" in maker:
        yield from _absorption(maker)


def _absorption(maker):
    law = f"{maker['absorption']} to waves of {maker['absorption_period [s]']:.4g} s"
    yield "absorption", f"{law}, with {_mm(maker['room [m]'])} to either side"
    reflected = f"{100 * maker['reflection_at_peak']:.1f} % there"
    if "reflection_over_spectrum" in maker:
        reflected += f", {100 * maker['reflection_over_spectrum']:.1f} % of the whole spectrum"
    yield "reflects by linear theory", reflected


def _sponges(zones):
    for i, zone in enumerate(zones):
        place = f"x = {zone['from [m]']:g} m to {zone['to [m]']:g} m"
        size = f"{zone['wavelengths']:.3g} wavelengths, strength {zone['strength']:.2g}"
        yield f"sponge.{i}", f"{place}, {size}"
        period = f"{100 * zone['reflection']:.2g} % of waves of {zone['period [s]']:.4g} s"
        yield "reflects by linear theory", period


def _tank_motion(tank):
    yield "type", tank["type"]
    for name in ("sway", "heave"):
        if f"{name} [m]" in tank:
            yield name, f"up to {_mm(tank[f'{name} [m]'])}"
    if "roll [deg]" in tank:
        yield "roll", f"up to {tank['roll [deg]']:.3g} degrees"
    if "period [s]" in tank:
        yield "period", f"{tank['period [s]']:.4g} s"
    yield "largest acceleration", f"{tank['largest_acceleration [m/s2]']:.3g} m/s2"
    if "natural_period [s]" in tank:
        yield "natural period of the water", f"{tank['natural_period [s]']:.4g} s"
    if "rise [m]" in tank:
        rise, room = _mm(tank["rise [m]"]), _mm(tank["room [m]"])
        yield "rise at the walls", f"{rise} by linear theory, without damping; room for {room}"


def _sea(maker):
    if "significant_height [m]" in maker:
        yield "Hm0 of the record", _mm(maker["significant_height [m]"])
    if "largest_height [m]" in maker:
        yield "Hmax at the piston", f"{_mm(maker['largest_height [m]'])} of {maker['waves']} waves"
    if "spectrum_left_out" in maker:
        yield "spectrum left out", f"{100 * maker['spectrum_left_out']:.2g} %"
        shortest = maker["shortest_wavelength [m]"]
        yield "components", f"{maker['components']}, down to a wave of {shortest:.3g} m"
    if "repeats_after [s]" in maker:
        yield "comes again after", f"{maker['repeats_after [s]']:.4g} s"
    if "group_period [s]" in maker:
        yield "groups", f"of {maker['group_period [s]']:.4g} s"
    if "crest [m]" in maker:
        yield "crest", f"{_mm(maker['crest [m]'])} above still water"


def _mm(length):
    return f"{length * 1e3:.3g} mm"


def _wave(wave, spacing):
    height = wave["height [m]"]
    yield "height H", f"{_mm(height)}, {height / spacing:.3g} spacings"
    yield from _regular(wave) if "wavelength [m]" in wave else _solitary(wave)


def _regular(wave):
    yield "wavelength L", f"{wave['wavelength [m]']:.4g} m (linear theory)"
    yield "kh", f"{wave['kh']:.3g}"
    yield "H/h, H/L", f"{wave['height_over_depth']:.3g}, {wave['height_over_length']:.3g}"
    yield "Ursell number H L^2/h^3", f"{wave['ursell_number']:.3g}"
    inside = wave["second_order_in_range"]
    madsen = f"in range ({LIMIT})" if inside else f"out of range ({LIMIT}); cnoidal regime"
    yield "second order piston theory", madsen
    if "slope" in wave:
        yield (
            "surf similarity",
            (
                f"{wave['surf_similarity']:.3g} on the slope of {wave['slope']:.3g}: "
                f"{wave['breaker_type']}"
            ),
        )
    if "runup [m]" in wave:
        outside = "" if wave["breaking_in_range"] else (
            f"; outside of its range, slopes up to {breaking.GODA_STEEPEST:g}")  # fmt: skip
        depth, breaker = _mm(wave["breaking_depth [m]"]), _mm(wave["breaking_height [m]"])
        yield "breaking point (Goda 2010)", f"depth {depth}, height {breaker}{outside}"
        yield "run-up (Hunt)", f"{_mm(wave['runup [m]'])} above still water"


def _solitary(wave):
    yield "H/h", f"{wave['height_over_depth']:.3g}"
    yield "celerity", f"{wave['celerity [m/s]']:.3g} m/s"
    if "breaks" in wave:
        breaks = "breaks" if wave["breaks"] else "does not break (Synolakis 1987)"
        yield "run-up on the beach", breaks
