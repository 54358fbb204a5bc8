"""The still water of a run: its level, and whether anything moves it."""


def still_level(case):
    """Level of the still water [m]; None where the water does not begin at one.

    Boxes of water in front of a wavemaker that all reach up to the depth of the tank are still
    water; others, as the column of a dam break, are not.

    Parameters
    ----------
    case : dict
        The resolved case as its TOML file holds it.
    """
    depth, boxes = case["tank"]["depth"], case.get("water", ())
    near = 0.5 * case["particles"]["spacing"]
    filled = all(
        box.get("shape", "box") == "box" and abs(box["to"][2] - depth) < near for box in boxes
    )
    return depth if not boxes or (filled and case["wavemaker"]["type"] != "none") else None


def at_rest(case):
    """Whether nothing in a case, as its TOML file holds it, moves its water."""
    kinds = {"wavemaker": ("none", "still"), "initial": ("rest",), "frame": ("none",)}
    driven = [name for name, calm in kinds.items() if case.get(name, {}).get("type") not in calm]
    moved = [one for one in case.get("solid", ()) if one.get("motion", "none") != "none"]
    return not (driven or moved or case.get("gate")) and still_level(case) is not None
