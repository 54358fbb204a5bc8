"""A finished run, as a case sees it."""

from mpslab.analysis import results


class Run(results.Run):
    """Reads the folder of a run; one that failed early has no steps, and may have no folder."""

    @property
    def spacing(self):
        """Particle spacing [m]."""
        return self.case.particles.spacing

    @property
    def depth(self):
        """Depth of the still water [m]."""
        return self.case.tank.depth

    @property
    def label(self):
        """Recipe, spacing and seed, as "standard, 3-D, d0 = 2 mm, seed 1"."""
        scheme, seed = self.case.scheme, self.case.particles.seed
        recipe = "mps" if scheme.gradient == "mps" else scheme.recipe
        width = ", 3-D" if self.case.tank.width else ""
        other = f", seed {seed}" if seed else ""
        return f"{recipe}{width}, d0 = {1e3 * self.spacing:.3g} mm{other}"

    @property
    def gravity(self):
        """Acceleration of gravity [m/s2]."""
        return self.case.fluid.gravity

    @property
    def density(self):
        """Density of the water [kg/m3]."""
        return self.case.fluid.density

    def gauge(self, name):
        """Time [s] and water level [m] of a gauge, (n,) each."""
        return self.gauges["time"], self.gauges[name]

    def pressure(self, name):
        """Time [s] and pressure [Pa] of a probe, (n,) each."""
        return self.probes["time"], self.probes[f"{name} pressure"]

    def water(self):
        """Time [s], position (n, 3) [m] and velocity (n, 3) [m/s] of the water, frame by frame."""
        for frame in self.frames:
            place, velocity = frame.position[frame.fluid], frame.velocity[frame.fluid]
            yield frame.time, place.astype(float), velocity.astype(float)

    def momentum(self):
        """Momentum of the water along x in the first and in the last frame [N s]."""
        mass = self.density * self.spacing**self.case.dim
        ends = self.frames[0], self.frames[-1]
        return [mass * float(end.velocity[end.fluid, 0].sum(dtype=float)) for end in ends]
