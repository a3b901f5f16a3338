"""The sections of a case as types, by which editors complete keys and mypy finds wrong ones.

Made of the schema of a case file: LIGAMENT_WRITE_KEYS=1 cargo test --release -p ligament-case --test integration case_schema
"""

# ruff: noqa: E501
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from numpy.typing import NDArray

Numbers = Sequence[float] | NDArray[Any]
Function = Callable[..., Any]


class Material(TypedDict, total=False):
    """The material of the whole body; or a table `[material.NAME]` with a `group` for each of several."""

    young: float
    """Young's modulus, Pa."""
    poisson: float
    """Poisson's ratio."""
    young_1: float
    """Young's modulus along the axis 1, Pa."""
    young_2: float
    """Young's modulus along the axis 2, Pa."""
    poisson_12: float
    """Poisson's ratio: contraction along 2 under stress along 1."""
    shear_modulus: float
    """Shear modulus in the plane, Pa."""
    angle: float
    """Angle from the x axis to axis 1, counter-clockwise, rad. Default 0.0."""
    young_3: float
    """Young's modulus across the plane, Pa; for plane strain."""
    poisson_13: float
    """Poisson's ratio: contraction across the plane under stress along 1; for plane strain."""
    poisson_23: float
    """Poisson's ratio: contraction across the plane under stress along 2; for plane strain."""
    c11: float
    """Stiffness of sigma_xx by eps_xx, Pa."""
    c12: float
    """Stiffness of sigma_xx by eps_yy, Pa."""
    c16: float
    """Stiffness of sigma_xx by gamma_xy, Pa."""
    c22: float
    """Stiffness of sigma_yy by eps_yy, Pa."""
    c26: float
    """Stiffness of sigma_yy by gamma_xy, Pa."""
    c66: float
    """Stiffness of sigma_xy by gamma_xy, Pa."""
    tensile_strength: float
    """Tensile strength, Pa."""
    compressive_strength: float
    """Compressive strength, Pa, positive."""
    fracture_energy: float
    """Fracture energy of opening, J/m^2."""
    fracture_energy_sliding: float
    """Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`."""
    mixed_mode_exponent: float
    """Exponent eta between the two fracture energies; for `mixed-mode`."""
    density: float
    """Mass density, kg/m^3; for natural modes."""
    thermal_expansion: float
    """Coefficient of linear thermal expansion, 1/K, the same in all directions; steel has 12e-6."""
    thermal_expansion_1: float
    """Thermal expansion along the axis 1, 1/K."""
    thermal_expansion_2: float
    """Thermal expansion along the axis 2, 1/K."""
    thermal_expansion_3: float
    """Thermal expansion across the plane, 1/K; for plane strain."""


class MaterialPart(TypedDict, total=False):
    """The material of a group."""

    group: str
    """The physical surface of the mesh, or the set of the lattice, that the material fills."""
    young: float
    """Young's modulus, Pa."""
    poisson: float
    """Poisson's ratio."""
    young_1: float
    """Young's modulus along the axis 1, Pa."""
    young_2: float
    """Young's modulus along the axis 2, Pa."""
    poisson_12: float
    """Poisson's ratio: contraction along 2 under stress along 1."""
    shear_modulus: float
    """Shear modulus in the plane, Pa."""
    angle: float
    """Angle from the x axis to axis 1, counter-clockwise, rad. Default 0.0."""
    young_3: float
    """Young's modulus across the plane, Pa; for plane strain."""
    poisson_13: float
    """Poisson's ratio: contraction across the plane under stress along 1; for plane strain."""
    poisson_23: float
    """Poisson's ratio: contraction across the plane under stress along 2; for plane strain."""
    c11: float
    """Stiffness of sigma_xx by eps_xx, Pa."""
    c12: float
    """Stiffness of sigma_xx by eps_yy, Pa."""
    c16: float
    """Stiffness of sigma_xx by gamma_xy, Pa."""
    c22: float
    """Stiffness of sigma_yy by eps_yy, Pa."""
    c26: float
    """Stiffness of sigma_yy by gamma_xy, Pa."""
    c66: float
    """Stiffness of sigma_xy by gamma_xy, Pa."""
    tensile_strength: float
    """Tensile strength, Pa."""
    compressive_strength: float
    """Compressive strength, Pa, positive."""
    fracture_energy: float
    """Fracture energy of opening, J/m^2."""
    fracture_energy_sliding: float
    """Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`."""
    mixed_mode_exponent: float
    """Exponent eta between the two fracture energies; for `mixed-mode`."""
    density: float
    """Mass density, kg/m^3; for natural modes."""
    thermal_expansion: float
    """Coefficient of linear thermal expansion, 1/K, the same in all directions; steel has 12e-6."""
    thermal_expansion_1: float
    """Thermal expansion along the axis 1, 1/K."""
    thermal_expansion_2: float
    """Thermal expansion along the axis 2, 1/K."""
    thermal_expansion_3: float
    """Thermal expansion across the plane, 1/K; for plane strain."""


class Interface(TypedDict, total=False):
    """An interface between two materials, whose bonds have strengths of their own. A property that is not given is the smaller one of both
materials."""

    between: Sequence[str]
    """Names or groups of the two materials, `["a", "b"]`; points on the interface hold to the first."""
    tensile_strength: float
    """Tensile strength, Pa."""
    compressive_strength: float
    """Compressive strength, Pa, positive."""
    fracture_energy: float
    """Fracture energy of opening, J/m^2."""
    fracture_energy_sliding: float
    """Fracture energy of sliding where it is another, J/m^2; for `mixed-mode`."""


class Model(TypedDict, total=False):
    """The bond model."""

    law: Literal["nhpd", "bbpd", "bbpd-conical", "pds", "mppd", "mppd-beam", "orthotropic", "mbb-pd"]
    """The bond law.

- `nhpd`: Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.
- `bbpd`: Central forces alone; Poisson's ratio 1/3, or 1/4 in plane strain.
- `bbpd-conical`: Central forces with a stiffness that falls with the length.
- `pds`: Normal and constant shear stiffness, no rotations of the points.
- `mppd`: Normal and constant shear stiffness, rotations.
- `mppd-beam`: Micropolar bonds in the form of a beam: shear stiffness falls with the length.
- `orthotropic`: Stiffness by the direction in the axes of an orthotropic material, rotations.
- `mbb-pd`: All strains of a small rectangle around each bond of a lattice."""
    horizon_factor: float
    """Horizon of each point over the distance to its nearest neighbour, lambda; 3 is usual."""
    horizon: float
    """One horizon for all points, m, in the place of `horizon_factor`."""
    bonds_through_voids: bool
    """Whether bonds run through holes, slots and notches of a mesh, as if these were filled. Default false."""
    closing: bool
    """Whether the faces of cracks carry pressure again where they close; of laws whose points turn. Default false."""
    closing_friction: float
    """Coefficient of friction on faces that close; not along the exact path. Default 0.0."""
    allow_unstable: bool
    """Whether a run goes on where the intact model is unstable, with more negative eigenvalues than its rotations explain; its results are
then not to be trusted. Default false."""
    poisson: Literal["cells", "bonds"]
    """Carrier of the stiffness that bonds cannot have above a Poisson's ratio of 1/4 (in plane stress 1/3); of `nhpd`, `bbpd`, `pds`, `mppd`, `mppd-beam`, `orthotropic`.

- `cells`: The cells of the body, by their changes of volume.
- `bonds`: The bonds, with a negative shear stiffness: the form of the papers, which cracks make unstable."""
    calibration: Literal["integral", "discrete"]
    """Origin of the constants of the law; of `bbpd`, `bbpd-conical`, `pds`, `mppd`, `mppd-beam`.

- `integral`: Integrals over a full circle, as in the papers.
- `discrete`: Sums over the family of each point."""
    rotational_stiffness: Literal["decaying", "quarter", "beam", "none"]
    """Stiffness against relative rotation; of `mppd`, `orthotropic`.

- `decaying`: k_theta = k_t l (1 - l/H)/2.
- `quarter`: k_theta = k_t l/4.
- `beam`: k_theta = k_t l/12.
- `none`: k_theta = 0."""
    rotational_factor: float
    """Rotational stiffness over the stiffness of the law; 1 without the key; of `nhpd`, `mppd`, `mppd-beam`, `orthotropic`."""
    cosserat_length: float
    """Stiffness against relative rotation of a Cosserat continuum with this characteristic length in bending, m; in the place of
`rotational_factor`."""
    form: Literal["full", "rows", "pairwise"]
    """Strains that the bonds of `mbb-pd` resist.

- `full`: Every bond resists all three strains.
- `rows`: Bonds along x and y resist only their own strain.
- `pairwise`: The form as printed, with forces only on the two ends of a bond."""
    strains: Literal["small", "true"]
    """Distances in the denominators of the strains of `mbb-pd`.

- `small`: The distances before the deformation.
- `true`: The distances after the deformation."""


class Correction(TypedDict, total=False):
    """The corrections of the bonds; without it as in the paper of the law."""

    alpha: Literal["none", "partial-volume", "length"]
    """The factor alpha of each bond; without it as in the paper of the law.

- `none`: 1.
- `partial-volume`: The share of the cell inside the horizon.
- `length`: NHPD's factor by length."""
    surface: Literal["none", "volume", "domain", "patch"]
    """The correction of surfaces; without it as in the paper of the law.

- `none`: None.
- `volume`: By the volumes of the families.
- `domain`: NHPD's iterative domain correction.
- `patch`: Two factors a bond for which every uniform strain is an equilibrium."""
    rule: Literal["auto", "sum", "mean"]
    """Measure of the change in a sweep of the domain correction.

- `auto`: `sum` for models of up to a million bonds, `mean` for larger ones, each with its default tolerance.
- `sum`: Summed over all bonds (the paper's): grows with the size of the model.
- `mean`: Mean per bond: independent of the size of the model."""
    tolerance: float
    """Change of a sweep below which the domain correction has converged."""
    max_sweeps: int
    """Sweeps of the domain correction at most. Default 500."""
    reference: Literal["body", "families"]
    """Reference factors, from which the factors of the patch correction differ as little as they can.

- `body`: alpha times one number for the body.
- `families`: alpha times factors with which a dilation has one stress at all points, also where the mesh is graded. Default "families"."""
    smallest_factor: float
    """Smallest factor of the patch correction over the uncorrected one. Default 0.02."""
    largest_factor: float
    """Largest factor of the patch correction over the uncorrected one. Default 20.0."""
    moment_weight: float
    """Weight of the equations of moments relative to the equations of forces in the patch correction. Default 0.04."""
    regularisation: float
    """Regularisation of the patch correction, for equations that cannot be satisfied. Default 1e-6."""
    domain: Literal["whole", "cracked"]
    """The body that the correction sees.

- `whole`: Before the pre-cracks cut bonds.
- `cracked`: After the pre-cracks cut bonds. Default "whole"."""


class Precrack(TypedDict, total=False):
    """A crack that is there from the start."""

    points: Sequence[Numbers]
    """Corners of the polyline, two or more `[x, y]`, m; in a solid of a plane polygon, three or more `[x, y, z]`."""
    centre: Numbers
    """Middle of a straight crack, m; with `length` and `angle` in the place of `points`. In a solid the middle of a disk, with `normal` and
`radius`."""
    length: float
    """Length of a straight crack, m."""
    angle: float
    """Angle from the x axis to a straight crack, counter-clockwise, rad."""
    normal: Numbers
    """Normal of a disk in a solid."""
    radius: float
    """Radius of a disk in a solid, m."""
    group: str
    """The faces of this physical surface of a solid mesh, or the edges of this physical curve of a mesh in the plane."""
    ends: Literal["excluded", "included"]
    """Whether bonds that only touch the crack are cut.

- `excluded`: Bonds that pass through the crack are cut.
- `included`: Bonds that have a point in common with the crack are cut. Default "excluded"."""


class SupportDisplacement(TypedDict, total=False):
    """The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad."""

    x: float
    """Component along x, m."""
    y: float
    """Component along y, m."""
    rotation: float
    """Rotation in the plane, rad, counter-clockwise."""
    z: float
    """Component along z of a solid, m."""
    rotation_x: float
    """Rotation about x in a solid, rad, right-handed."""
    rotation_y: float
    """Rotation about y in a solid, rad, right-handed."""
    rotation_z: float
    """Rotation about z in a solid, rad, right-handed."""


class SupportStiffness(TypedDict, total=False):
    """Springs to the ground instead of fixed displacements, in total over the points."""

    x: float
    """Stiffness along x, N/m."""
    y: float
    """Stiffness along y, N/m."""
    rotation: float
    """Stiffness against rotations of the points, in N m/rad."""
    z: float
    """Stiffness along z of a solid, N/m."""
    normal: float
    """Stiffness along the `normal` of the support, N/m."""


class Support(TypedDict, total=False):
    """A support: displacements held at zero, or resisted by springs."""

    group: str
    """The points of this physical group of the mesh, or of this set or hole of the lattice."""
    box: Sequence[Numbers]
    """The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m."""
    at: Numbers
    """The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m."""
    displacement: SupportDisplacement
    """The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad."""
    normal: Numbers
    """An inclined roller: the direction along which the points are held while they are free across it, `[1.0, 1.0]` is at 45 degrees."""
    stiffness: SupportStiffness
    """Springs to the ground instead of fixed displacements, in total over the points."""


class LoadDisplacement(TypedDict, total=False):
    """Prescribed displacements, m, rotation in rad."""

    x: float
    """Component along x, m."""
    y: float
    """Component along y, m."""
    rotation: float
    """Rotation in the plane, rad, counter-clockwise."""
    z: float
    """Component along z of a solid, m."""
    rotation_x: float
    """Rotation about x in a solid, rad, right-handed."""
    rotation_y: float
    """Rotation about y in a solid, rad, right-handed."""
    rotation_z: float
    """Rotation about z in a solid, rad, right-handed."""


class LoadVelocity(TypedDict, total=False):
    """Prescribed velocities in a motion, m/s, of the rotation rad/s."""

    x: float
    """Component along x."""
    y: float
    """Component along y."""
    rotation: float
    """Component of the rotation in the plane, counter-clockwise, with rad in the place of m."""
    z: float
    """Component along z of a solid."""
    rotation_x: float
    """Component of the rotation about x in a solid, right-handed."""
    rotation_y: float
    """Component of the rotation about y in a solid, right-handed."""
    rotation_z: float
    """Component of the rotation about z in a solid, right-handed."""


class LoadBaseAcceleration(TypedDict, total=False):
    """Prescribed accelerations in a motion, such as the acceleration of the ground, m/s^2, of the rotation rad/s^2."""

    x: float
    """Component along x."""
    y: float
    """Component along y."""
    rotation: float
    """Component of the rotation in the plane, counter-clockwise, with rad in the place of m."""
    z: float
    """Component along z of a solid."""
    rotation_x: float
    """Component of the rotation about x in a solid, right-handed."""
    rotation_y: float
    """Component of the rotation about y in a solid, right-handed."""
    rotation_z: float
    """Component of the rotation about z in a solid, right-handed."""


class LoadForce(TypedDict, total=False):
    """A force in total over the points, N."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadForcePerLength(TypedDict, total=False):
    """A force along the edges of a group, N/m."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadForcePerArea(TypedDict, total=False):
    """A force over the surface of a group of a solid, N/m^2."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadBodyForce(TypedDict, total=False):
    """A force in the volume, N/m^3; on the whole body without a place."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadAcceleration(TypedDict, total=False):
    """An acceleration that acts on all masses, as gravity does, m/s^2; on the whole body without a place, and the materials need a
`density`."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadMoment(TypedDict, total=False):
    """A vector; a component that is not given is zero."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadBodyCouple(TypedDict, total=False):
    """A vector; a component that is not given is zero."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class LoadProfile(TypedDict, total=False):
    """Variation of the load in space: a factor (c - zero)/(one - zero), or the factor of a table."""

    along: Literal["x", "y", "z"]
    """Coordinate along which the load varies.

- `x`: Along x.
- `y`: Along y.
- `z`: Along z of a solid."""
    zero: float
    """Coordinate in the mesh file at which the load is zero, m."""
    one: float
    """Coordinate in the mesh file at which it is as given, m."""
    file: str | PathLike[str]
    """A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `factor`, with a row for each loaded point, from the folder of
the case file."""


class LoadAmplitude(TypedDict, total=False):
    """Variation of the load in time, in a motion: a factor of the load. Without it the load is as given from the start."""

    points: Sequence[Numbers]
    """Times (s) with the factors there, `[[0.0, 0.0], [1e-3, 1.0]]`: straight between them, constant before and after."""
    file: str | PathLike[str]
    """A CSV file with the columns `time` (s) and `factor`, from the folder of the case file; as `points`."""
    shape: Literal["sine", "half-sine", "triangle", "rectangle", "ramp", "smooth-ramp", "ricker"]
    """A shape, from its start on.

- `sine`: sin(2 pi n x) of n `periods`.
- `half-sine`: sin(pi x).
- `triangle`: From 0 to 1 at half of the duration, and back.
- `rectangle`: 1 until the end.
- `ramp`: From 0 to 1, where it stays.
- `smooth-ramp`: From 0 to 1, where it stays, without kinks: 10 x^3 - 15 x^4 + 6 x^5.
- `ricker`: (1 - 2 a) exp(-a), a = (pi f (t - t_p))^2 with the `frequency` f and the `peak_time` t_p."""
    start: float
    """Start of the shape, s; without it 0. Default 0.0."""
    duration: float
    """Duration of the whole shape, s."""
    periods: int
    """Periods of a sine within its duration. Default 1."""
    peak_time: float
    """Time of the peak of a Ricker wavelet, s."""
    frequency: float
    """Frequency at which a Ricker wavelet has its most energy, Hz."""


class Load(TypedDict, total=False):
    """A load, with its value at load factor 1."""

    name: str
    """Name of its column in `history.csv`; by default the name of the group, or `load-1` and so on where that cannot head a column."""
    group: str
    """The points of this physical group of the mesh, or of this set or hole of the lattice."""
    box: Sequence[Numbers]
    """The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m."""
    at: Numbers
    """The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m."""
    displacement: LoadDisplacement
    """Prescribed displacements, m, rotation in rad."""
    velocity: LoadVelocity
    """Prescribed velocities in a motion, m/s, of the rotation rad/s."""
    base_acceleration: LoadBaseAcceleration
    """Prescribed accelerations in a motion, such as the acceleration of the ground, m/s^2, of the rotation rad/s^2."""
    force: LoadForce
    """A force in total over the points, N."""
    force_per_length: LoadForcePerLength
    """A force along the edges of a group, N/m."""
    force_per_area: LoadForcePerArea
    """A force over the surface of a group of a solid, N/m^2."""
    body_force: LoadBodyForce
    """A force in the volume, N/m^3; on the whole body without a place."""
    acceleration: LoadAcceleration
    """An acceleration that acts on all masses, as gravity does, m/s^2; on the whole body without a place, and the materials need a
`density`."""
    moment: float | LoadMoment
    """A couple in total over the points, N m: counter-clockwise, in a solid `{ x = 0.0, y = 0.0, z = 1.0 }`, right-handed."""
    body_couple: float | LoadBodyCouple
    """A couple in the volume, N m/m^3, as a `moment`; on the whole body without a place."""
    pressure: float
    """A pressure on the outline of a group, Pa; positive pushes on the body."""
    profile: LoadProfile | Function
    """Variation of the load in space: a factor (c - zero)/(one - zero), or the factor of a table."""
    amplitude: LoadAmplitude
    """Variation of the load in time, in a motion: a factor of the load. Without it the load is as given from the start."""
    stiffness: float
    """Total stiffness of springs through which a `displacement` moves the points, N/m: the stiffness of a testing machine."""
    tilts: bool
    """Whether a `displacement` or `force` acts through a rigid platen that may tilt: it moves by the mean of its points."""


class StageControl(TypedDict, total=False):
    """A quantity that grows in equal steps over the stage, while the loads follow in fixed proportion, past peaks and snap-backs. Without it the
factors of the loads grow."""

    probe: str
    """Name of a probe that reads a displacement or one between two points; load steps alone."""
    probes: Mapping[str, float]
    """Weights of such probes, by their names."""
    quantity: Literal["dissipated_energy"]
    """A quantity of the whole body.

- `dissipated_energy`: The energy that bonds have dissipated since the loading began, a column of `history.csv`: in load steps with softening bonds; along the exact
path it determines the end of the stage."""
    to: float
    """The value at the end of the stage, in the unit of the probe, or J."""


class Stage(TypedDict, total=False):
    """A stage of the loading: loads that go to other factors, each times the load as it is at factor 1."""

    name: str
    """Name in `history.csv`; by default `stage-1` and so on."""
    loads: Mapping[str, float | Numbers | Sequence[Numbers]]
    """Factors that loads go to, by the names of the loads; `temperature` for the temperatures. All others keep theirs, which is 0 at
first."""
    steps: int
    """Equal load steps of the stage; not on the exact path, nor in an elastic analysis."""
    control: StageControl
    """A quantity that grows in equal steps over the stage, while the loads follow in fixed proportion, past peaks and snap-backs. Without it the
factors of the loads grow."""


class Temperature(TypedDict, total=False):
    """A change of temperature at load factor 1. Where several apply, the last one counts."""

    group: str
    """The part of the body; the whole body without it or a `box`."""
    box: Sequence[Numbers]
    """The part of the body in this rectangle, by two opposite corners, in a solid in this box, m."""
    change: float | Function
    """Change of the temperature at load factor 1, the same everywhere there, K."""
    file: str | PathLike[str]
    """A CSV file with the columns `x`, `y` (m; of a solid also `z`) and `change` (K), from the folder of the case file."""
    mesh_field: str
    """A scalar field at the nodes in the mesh file, K; `ligament inspect` lists them."""
    time_step: int
    """Time step of the `mesh_field`, where the file has several."""
    reference: float
    """Subtracted from the values of the `mesh_field`, K. Default 0.0."""


class InitialVelocityVelocity(TypedDict, total=False):
    """The velocity, m/s."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class InitialVelocity(TypedDict, total=False):
    """A velocity at time zero. Where several apply, the last one counts."""

    group: str
    """The points of this physical group of the mesh, or of this set or hole of the lattice; without a place the whole body moves."""
    box: Sequence[Numbers]
    """The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m."""
    at: Numbers
    """The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m."""
    velocity: InitialVelocityVelocity
    """The velocity, m/s."""


class Quiet(TypedDict, total=False):
    """A part of the outline through which waves leave the body, by dashpots that take those at a right angle to it."""

    group: str
    """The physical group on the outline of the mesh, or the set or hole of the lattice."""


class Contact(TypedDict, total=False):
    """Contact between parts of the body, with friction."""

    between: Sequence[str]
    """Two groups whose outlines meet, `["a", "b"]`; without it all parts that no bond connects at the start."""
    friction: float
    """Coefficient of Coulomb's friction. Default 0.0."""
    stiffness: float
    """Stiffness of the contact over E'/h of the material, with the spacing h of the points. Default 1.0."""
    cracks: bool
    """Whether the faces of cracks take part, also those that come about; without `between` all fragments then meet each other. Default false."""


class RigidDisplacement(TypedDict, total=False):
    """Displacement at load factor 1, m; in statics."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class RigidVelocity(TypedDict, total=False):
    """Velocity in a motion, m/s: of a body with a `mass` at time zero, of another one times its `amplitude`."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class RigidAmplitude(TypedDict, total=False):
    """Factor of the velocity as a function of time; without it 1."""

    points: Sequence[Numbers]
    """Times (s) with the factors there, `[[0.0, 0.0], [1e-3, 1.0]]`: straight between them, constant before and after."""
    file: str | PathLike[str]
    """A CSV file with the columns `time` (s) and `factor`, from the folder of the case file; as `points`."""
    shape: Literal["sine", "half-sine", "triangle", "rectangle", "ramp", "smooth-ramp", "ricker"]
    """A shape, from its start on.

- `sine`: sin(2 pi n x) of n `periods`.
- `half-sine`: sin(pi x).
- `triangle`: From 0 to 1 at half of the duration, and back.
- `rectangle`: 1 until the end.
- `ramp`: From 0 to 1, where it stays.
- `smooth-ramp`: From 0 to 1, where it stays, without kinks: 10 x^3 - 15 x^4 + 6 x^5.
- `ricker`: (1 - 2 a) exp(-a), a = (pi f (t - t_p))^2 with the `frequency` f and the `peak_time` t_p."""
    start: float
    """Start of the shape, s; without it 0. Default 0.0."""
    duration: float
    """Duration of the whole shape, s."""
    periods: int
    """Periods of a sine within its duration. Default 1."""
    peak_time: float
    """Time of the peak of a Ricker wavelet, s."""
    frequency: float
    """Frequency at which a Ricker wavelet has its most energy, Hz."""


class RigidAcceleration(TypedDict, total=False):
    """Acceleration of a body with a `mass` without contacts, such as gravity, m/s^2."""

    x: float
    """Component along x, in the unit of the vector. Default 0.0."""
    y: float
    """Component along y, in the unit of the vector. Default 0.0."""
    z: float
    """Component along z of a solid, in the unit of the vector."""


class Rigid(TypedDict, total=False):
    """A rigid body that parts of the body meet."""

    name: str
    """Name in results."""
    shape: Literal["circle", "sphere", "wall", "box"]
    """Shape of the body.

- `circle`: A circle, for a body in the plane.
- `sphere`: A sphere, for a solid.
- `wall`: A half-plane, for a solid a half-space.
- `box`: A rectangle, for a solid a box, with sides along the axes."""
    centre: Numbers
    """Centre of the body at the start, of a wall a point of its surface, m."""
    radius: float
    """Radius of a circle or sphere, m."""
    normal: Numbers
    """Outward normal of a wall."""
    size: Numbers
    """Sides of a box, m."""
    displacement: RigidDisplacement
    """Displacement at load factor 1, m; in statics."""
    velocity: RigidVelocity
    """Velocity in a motion, m/s: of a body with a `mass` at time zero, of another one times its `amplitude`."""
    amplitude: RigidAmplitude
    """Factor of the velocity as a function of time; without it 1."""
    mass: float
    """Mass of a body that contact alone moves, in the plane for the whole thickness, kg; without it the motion is prescribed."""
    inertia: float
    """Moment of inertia of a body with a `mass` about its middle, in the plane about z, kg m^2; without it the body does not turn."""
    acceleration: RigidAcceleration
    """Acceleration of a body with a `mass` without contacts, such as gravity, m/s^2."""
    friction: float
    """Coefficient of Coulomb's friction. Default 0.0."""
    stiffness: float
    """Stiffness of the contact over E'/h of the material, with the spacing h of the points. Default 1.0."""
    against: Sequence[str]
    """Groups whose outlines it can touch; by default the outline of the whole body."""
    cracks: bool
    """Whether the rigid shape meets the faces of cracks as well. Default false."""


class FarFieldNear(TypedDict, total=False):
    """A part of the body."""

    group: str
    """The points of this physical group of the mesh, or of this set or hole of the lattice."""
    box: Sequence[Numbers]
    """The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m."""


class FarField(TypedDict, total=False):
    """Linear finite elements in place of bonds, away from parts of a meshed body."""

    near: Sequence[FarFieldNear]
    """Parts of the body that keep their bonds: the cells with all corners in one of them."""
    strength_share: float
    """Share of the strength of a material, up to 1, that the largest principal stress of elements may reach (under pressure the smallest one over
`compressive_strength`). Where a run meets a larger stress, bonds take the place of the elements around it, and the run begins anew. Without
it the near field stays as it is."""


class Refine(TypedDict, total=False):
    """Runs one after the other, each from the unloaded body, on meshes that are finer where bonds of the runs before broke."""

    size: float
    """Size of the cells where bonds break, m: the edge of an equilateral triangle, or of a regular tetrahedron."""
    levels: int
    """Number of times that the edges are halved where bonds break, in the place of `size`."""
    where: Literal["half", "softening", "broken"]
    """Bonds around which the mesh is refined.

- `half`: Bonds that broke or lost half of their force.
- `softening`: Bonds that broke or began to soften.
- `broken`: Bonds that broke. Default "half"."""
    strength_share: float
    """Share of the limit from which on brittle bonds outside of the fine part make it grow; bonds that soften do so only where no bond is open. Default 0.8."""
    tolerance: float
    """Relative change of peak and work, between two passes of one size, at which no other pass follows; the path changes by `size` at most. Default 0.02."""
    passes: int
    """Largest number of passes. Default 5."""
    pass_number: int
    """Number of the first pass; in results the number of the pass that they are from. Default 1."""
    places: str
    """A table with the columns `x` and `y`, in a solid also `z`, m: places around which the mesh is fine from the first pass on that refines it."""


class NoFail(TypedDict, total=False):
    """A part of the body."""

    group: str
    """The points of this physical group of the mesh, or of this set or hole of the lattice."""
    box: Sequence[Numbers]
    """The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m."""


class Probe(TypedDict, total=False):
    """A column of the history."""

    name: str
    """Name of its column in `history.csv`, another one for each probe."""
    between: Sequence[Numbers]
    """Two positions, m: the second displacement less the first, as of a strain gauge or a crack opening; with `component`."""
    at: Numbers
    """A position, m, at which a field is read between the points of the cell around it; with `field`."""
    section: Sequence[Numbers]
    """A line, m, through which the bonds carry a force, N; in a solid a point of a plane and one before it along its normal; with
`component`."""
    group: str
    """A group: with `field` the mean of the field over the volume of its points, with `component` the force that supports and loads exert
on them."""
    tip: Numbers
    """The end of a straight pre-crack in the plane, or a place on the rim of a disk or a plane polygon in a solid, m; with
`quantity`."""
    component: Literal["x", "y", "rotation", "z", "rotation_x", "rotation_y", "rotation_z"]
    """The component that `between` (m or rad), `section` (N; `x`, `y`, or `z` in a solid) or `group` (N or N m) reads.

- `x`: Displacement along x, m.
- `y`: Displacement along y, m.
- `rotation`: Rotation in the plane, rad, counter-clockwise.
- `z`: Displacement along z of a solid, m.
- `rotation_x`: Rotation about x in a solid, rad, right-handed.
- `rotation_y`: Rotation about y in a solid, rad, right-handed.
- `rotation_z`: Rotation about z in a solid, rad, right-handed."""
    field: Literal["damage", "strain_energy_density", "damage_tension", "damage_compression", "damage_sliding", "stress.xx", "stress.yy", "stress.zz", "stress.xy", "stress.yz", "stress.xz", "stress_principal.1", "stress_principal.2", "stress_principal.3", "stress_von_mises", "stress_tresca", "stress_effective.xx", "stress_effective.yy", "stress_effective.zz", "stress_effective.xy", "stress_effective.yz", "stress_effective.xz", "stress_effective_principal.1", "stress_effective_principal.2", "stress_effective_principal.3", "displacement.x", "displacement.y", "rotation", "displacement.z", "rotation.x", "rotation.y", "rotation.z", "velocity.x", "velocity.y", "velocity.z", "acceleration.x", "acceleration.y", "acceleration.z", "stress_virial.xx", "stress_virial.yy", "stress_virial.xy", "stress_virial.zz", "stress_virial.xz", "stress_virial.yz", "strain.xx", "strain.yy", "strain.xy", "strain.zz", "strain.xz", "strain.yz"]
    """The field that is read `at` the position or in the `group`.

- `damage`: Share of the point's bonds that are broken, weighted with volumes, 0 to 1.
- `strain_energy_density`: Strain energy density, J/m^3: energy stored in the point's bonds, half of each.
- `damage_tension`: Damage by opening of bonds, d_t, 0 to 1.
- `damage_compression`: Damage by crushing of bonds, d_c.
- `damage_sliding`: Damage by sliding of bonds, d_gamma.
- `stress.xx`: Stress that the material carries xx, Pa.
- `stress.yy`: Stress that the material carries yy, Pa.
- `stress.zz`: Stress that the material carries zz, Pa.
- `stress.xy`: Stress that the material carries xy, Pa.
- `stress.yz`: Stress that the material carries yz, Pa.
- `stress.xz`: Stress that the material carries xz, Pa.
- `stress_principal.1`: Principal value of that stress 1, Pa.
- `stress_principal.2`: Principal value of that stress 2, Pa.
- `stress_principal.3`: Principal value of that stress 3, Pa.
- `stress_von_mises`: Equivalent stress of von Mises, Pa.
- `stress_tresca`: Equivalent stress of Tresca, Pa.
- `stress_effective.xx`: Effective stress xx, Pa.
- `stress_effective.yy`: Effective stress yy, Pa.
- `stress_effective.zz`: Effective stress zz, Pa.
- `stress_effective.xy`: Effective stress xy, Pa.
- `stress_effective.yz`: Effective stress yz, Pa.
- `stress_effective.xz`: Effective stress xz, Pa.
- `stress_effective_principal.1`: Principal value of the effective stress 1, Pa.
- `stress_effective_principal.2`: Principal value of the effective stress 2, Pa.
- `stress_effective_principal.3`: Principal value of the effective stress 3, Pa.
- `displacement.x`: Displacement along x, m.
- `displacement.y`: Displacement along y, m.
- `rotation`: Rotation in the plane, rad, counter-clockwise.
- `displacement.z`: Displacement along z of a solid, m.
- `rotation.x`: Rotation about x in a solid, rad, right-handed.
- `rotation.y`: Rotation about y in a solid, rad, right-handed.
- `rotation.z`: Rotation about z in a solid, rad, right-handed.
- `velocity.x`: Velocity along x in a motion, m/s.
- `velocity.y`: Velocity along y in a motion, m/s.
- `velocity.z`: Velocity along z of a solid in a motion, m/s.
- `acceleration.x`: Acceleration along x in a motion, m/s^2.
- `acceleration.y`: Acceleration along y in a motion, m/s^2.
- `acceleration.z`: Acceleration along z of a solid in a motion, m/s^2.
- `stress_virial.xx`: Virial stress xx, Pa.
- `stress_virial.yy`: Virial stress yy, Pa.
- `stress_virial.xy`: Virial stress xy, Pa.
- `stress_virial.zz`: Virial stress zz of a solid, Pa.
- `stress_virial.xz`: Virial stress xz of a solid, Pa.
- `stress_virial.yz`: Virial stress yz of a solid, Pa.
- `strain.xx`: Strain xx of the bonds that are left, with that by temperature.
- `strain.yy`: Strain yy.
- `strain.xy`: Shear strain xy, as the angle by which a right one changes.
- `strain.zz`: Strain zz of a solid.
- `strain.xz`: Shear strain xz of a solid.
- `strain.yz`: Shear strain yz of a solid."""
    quantity: Literal["J", "K_I", "K_II", "K_III", "advance"]
    """The quantity that is read at the `tip`.

- `J`: Energy release rate, J/m^2.
- `K_I`: Stress intensity factor of opening, Pa m^0.5.
- `K_II`: Stress intensity factor of sliding, Pa m^0.5: positive where the left side of the crack, seen towards its tip, slides towards the tip; in a solid the side of the normal.
- `K_III`: Stress intensity factor of sliding along the front of a solid, Pa m^0.5: positive where the side of the normal n slides along g x n, with the direction g of growth.
- `advance`: Length by which the crack has grown from the tip of the pre-crack, m: with `growing`."""
    radii: Numbers
    """The inner and the outer radius of the ring around the `tip` over which the quantity is integrated, m; without it two and four horizons."""
    front_length: float
    """The length of the front of a solid's pre-crack, with the `tip` in its middle, over which the quantity is a weighted mean, m; without it twice
the outer radius. The whole front of a disk if it is no longer."""
    growing: bool
    """Whether the ring follows the tip of a crack that grows from the `tip` in the plane."""


class FractureStop(TypedDict, total=False):
    """When to stop before the end of the loading; whichever comes first."""

    load_fraction: float
    """When the load has fallen to this share of its largest value; not where the load factor is below an earlier one."""
    displacement: float
    """When the displacement of the first load reaches this, m; in rad, m^3 or K where that is its unit."""
    bonds: int
    """When so many bonds are broken."""
    wall_time: float
    """After so much time, s."""
    negative_energy: bool
    """When the stored energy becomes negative, as it may where Poisson's ratio makes the bonds' shear stiffness negative. Default true."""


class FractureScatter(TypedDict, total=False):
    """A property that varies over the body at random, by a factor with the mean 1."""

    of: Literal["strength", "fracture-energy"]
    """Property that varies.

- `strength`: Strengths, and limits given in their place.
- `fracture-energy`: Fracture energies."""
    distribution: Literal["weibull", "normal", "lognormal"]
    """Distribution of the factors.

- `weibull`: Weibull's with two parameters, by its `modulus`.
- `normal`: Normal with a `deviation`, cut off at four of them.
- `lognormal`: Lognormal with a `deviation`. Default "weibull"."""
    modulus: float
    """Weibull modulus; of `weibull`: 5 scatters by 23 %, 12 by 10 %, 25 by 5 %."""
    deviation: float
    """Standard deviation over the mean; of `normal`, where it is less than 0.25, and of `lognormal`."""
    seed: int
    """Seed of the random numbers: another seed gives another specimen. The default is 0; the seed of a second property follows from the first."""
    correlation_length: float
    """Distance over which the correlation exp(-(r/L)^2) of two places falls to 1/e, m; 0: each point for itself. Default 0.0."""


class FractureCriterionAfter(TypedDict, total=False):
    """A law by a curve of stress over the opening of a crack; one of the keys."""

    curve: Sequence[Numbers]
    """Opening and stress of each corner, from the opening 0 and the strength to the stress 0. Units do not matter: the curve is scaled so
that the `fracture_energy` comes out."""
    kink: Numbers
    """Point at which two straight lines meet: opening over the opening at the end, and stress over the strength."""
    table: str
    """A table (`.csv`) of the corners with the columns `opening` and `stress`, from the folder of the case file."""


class FractureCriterion(TypedDict, total=False):
    """A criterion of failure."""

    kind: Literal["strength", "bond-rankine", "rankine", "mohr-coulomb", "tension", "compression", "fibre", "sliding", "frictional", "critical-stretch", "bond-energy", "mixed-mode", "printed-opening", "printed-sliding", "printed-mixed"]
    """Kind of failure and origin of the limit.

- `strength`: Stretch, from the energy at the `tensile_strength` (NHPD).
- `bond-rankine`: Tensile stress on the plane across the bond, from the `tensile_strength`: the strength of the material under any stress.
- `rankine`: Largest principal stress around the bond, at which it begins to soften, from the `tensile_strength`; it takes what `bond-energy` gives it, from the `fracture_energy`.
- `mohr-coulomb`: Tension up to the `tensile_strength`, and shear with friction, from the `compressive_strength` and a `friction_angle` or one that fits both strengths, or from a `cohesion` and a `friction_angle`; where bonds soften, by the `fracture_energy` and by `fracture_energy_sliding`.
- `tension`: Stretch, from the `tensile_strength` or a `limit`.
- `compression`: Shortening, from the `compressive_strength` or a `limit`.
- `fibre`: Stretch of the outermost fibre of a bond that bends, from the `tensile_strength` or a `limit`; with a `fibre_distance`.
- `sliding`: Sliding, from the `tensile_strength` or a `limit`.
- `frictional`: Sliding that compression makes harder, from both strengths, from the `tensile_strength` and a `friction_angle`, or from a `limit` and a `friction_angle`.
- `critical-stretch`: Stretch, from the `fracture_energy` or a `limit`.
- `bond-energy`: Energy of stretch and sliding, from the `fracture_energy` or a `limit`; where bonds soften, from the `tensile_strength`.
- `mixed-mode`: Opening and shear of the bonds of `mbb-pd`, from the fracture energies or limits of both.
- `printed-opening`: Critical stretch and angle of the bonds of `mbb-pd` in mode I as printed, from the fracture energy and the bonds left.
- `printed-sliding`: Critical stretch and angle of the bonds of `mbb-pd` in mode II as printed, from the fracture energy and the bonds left.
- `printed-mixed`: Critical stretch and angle of the bonds of `mbb-pd` in both modes as printed, from the fracture energies and the bonds left."""
    limit: float
    """Stretch, shortening or sliding at which a bond fails, in the place of the strength or the energy of the material."""
    critical_stretch: float
    """Stretch at which a bond without shear fails; of `mixed-mode`, with `critical_angle`."""
    critical_angle: float
    """Shear at which a bond that does not open fails, rad; of `mixed-mode`, with `critical_stretch`."""
    calibration: Literal["printed", "two-point"]
    """Derivation of the limit of `frictional` from the strengths.

- `printed`: As printed: exact without lateral strain alone.
- `two-point`: From the strains of a bar under both strengths. Default "printed"."""
    friction_angle: float
    """Angle of friction, rad. For `mohr-coulomb` it is the angle phi of the material; for `frictional` the angle beta of a bond, in the place of
the compressive strength: compression by s makes its limit of sliding larger by s tan(beta)."""
    cohesion: float
    """Cohesion of `mohr-coulomb`, Pa, in the place of the compressive strength; with `friction_angle`."""
    fibre_distance: float
    """Distance of the outermost fibre from the axis of a bond, m; of `fibre`."""
    after: Literal["brittle", "linear", "two-branch", "cornelissen", "ceb-fip", "model-code-2010", "exponential", "plastic", "bilinear"] | FractureCriterionAfter
    """Behaviour of a bond after its limit: a word, or a curve of stress over the opening of a crack.

- `brittle`: It breaks.
- `linear`: Its force falls in one straight line to zero.
- `two-branch`: Its force falls in two straight lines, to a third and then to zero (Petersson's, of concrete).
- `cornelissen`: Its force falls by the curve of Cornelissen, Hordijk and Reinhardt, of concrete.
- `ceb-fip`: Its force falls in two straight lines, to .15 and then to zero (CEB-FIP Model Code 1990, aggregates of 16 mm).
- `model-code-2010`: Its force falls in two straight lines, to a fifth and then to zero (fib Model Code 2010).
- `exponential`: Its force falls exponentially.
- `plastic`: Its force stays; of `sliding` alone.
- `bilinear`: Older word for `linear`: one straight line, not the two of `two-branch` that concrete has. Default "brittle"."""
    end: float
    """Deformation at which the force has fallen to zero, over the deformation at the limit: above 1 for `linear`, above 3 for `two-branch`;
without it the value that gives the `fracture_energy`."""
    scale: float
    """Scale of the fall of `exponential` over the deformation at the limit; without it so that the `fracture_energy` comes out."""


class Fracture(TypedDict, total=False):
    """How bonds break; without it the case is one linear elastic solution."""

    control: Literal["stepped", "event"]
    """Control of the load.

- `stepped`: Load steps, given by `steps`; in each, bonds break until none is beyond its limit.
- `event`: The exact path from breakage to breakage up to load factor 1, without steps and with snap-back. Default "stepped"."""
    steps: int | Numbers
    """The load steps: a number of equal steps up to load factor 1, or a list of load factors. With stages each stage has its own."""
    bonds_per_iteration: int
    """Bonds broken at most between two solutions. Default 5."""
    order: Literal["excess", "ratio"]
    """Order in which the bonds beyond their limit break.

- `excess`: Bonds with the largest excess of stretch over critical stretch (the paper's).
- `ratio`: Bonds with the largest ratio of stretch to critical stretch. Default "excess"."""
    max_iterations: int
    """Rounds of breaking at most in a load step. Default 10000."""
    refine_first_break: int
    """Number of parts into which the load step of the first breakage is divided after it; 0 for no division. Default 0."""
    tie_tolerance: float
    """Bonds closer than this (relative) to the worst one break together with it. Default 1e-8."""
    energy_tolerance: float
    """Relative change of energy below which a solution is in equilibrium. Default 0.0001."""
    stop: FractureStop
    """When to stop before the end of the loading; whichever comes first."""
    scatter: FractureScatter | Sequence[FractureScatter]
    """A strength or a fracture energy that varies over the body at random; both as a list of two tables."""
    criterion: Sequence[FractureCriterion]
    """Criteria for the failure of bonds: the first that is met decides; without any, by the strength (`mbb-pd`: `mixed-mode`)."""


class Modal(TypedDict, total=False):
    """Requested natural modes, with `analysis = "modal"`."""

    modes: int
    """Number of modes, rigid ones included, lowest first. Default 10."""
    rotations: Literal["auto", "inertia", "massless"]
    """Inertia of the rotations of the points.

- `auto`: `inertia` where no bond has a negative shear stiffness, `massless` otherwise.
- `inertia`: Rotations have the inertia of a square with the point's volume.
- `massless`: Rotations have no inertia and follow the displacements. Default "auto"."""
    tolerance: float
    """Residual of the search, relative to 1/omega^2. Default 1e-10."""


class MotionDamping(TypedDict, total=False):
    """Damping C = `mass` M + `stiffness` K."""

    mass: float
    """alpha, 1/s: slow motions are damped most. Default 0.0."""
    stiffness: float
    """beta, s: fast motions are damped most; it shortens the critical step. Default 0.0."""


class MotionStop(TypedDict, total=False):
    """When to stop before the end; whichever comes first."""

    bonds: int
    """When so many bonds are broken."""
    wall_time: float
    """After so much time of the machine, s."""


class Motion(TypedDict, total=False):
    """A motion in time under loads that depend on time."""

    duration: float
    """Time at the end, s."""
    rows: int
    """Rows of the history, at equal times. Default 200."""
    scheme: Literal["explicit", "implicit", "auto"]
    """Scheme of the integration in time.

- `explicit`: Central differences: steps without equations to solve, shorter than a critical step.
- `implicit`: Newmark's scheme: steps of any length, each an equilibrium with inertia; of `[fracture]` the keys of a load step hold for each.
- `auto`: Equilibria without inertia from row to row until the body loses its balance, then implicit steps until it is at rest, then equilibria
again. Default "explicit"."""
    step: float
    """Time step, s; explicit steps without it are `safety` times the critical step of the body. It is shortened so that rows are at
multiples of it, and implicit steps are halved where bonds break fast."""
    safety: float
    """Share of the critical step, beyond which explicit steps are unstable. Default 0.8."""
    dissipation: float
    """Dissipation of fast motions by implicit steps, after Hilber, Hughes and Taylor: 0 takes no energy. Default 0.0."""
    statics: float
    """Share of the work so far that a step without inertia may set free beyond what its bonds dissipate, and that a motion may have left when
equilibria follow again; for the scheme `auto`. Default 0.001."""
    rotary_inertia: float
    """Factor on the rotational inertia of the points; a larger one allows longer steps where rotations limit them. Default 1.0."""
    damping: MotionDamping
    """Damping C = `mass` M + `stiffness` K."""
    stop: MotionStop
    """When to stop before the end; whichever comes first."""


class Solver(TypedDict, total=False):
    """How the equations are solved. The results are the same up to rounding."""

    method: Literal["auto", "direct", "iterative"]
    """How the equations are solved: with a factor of the matrix or without a matrix.

- `auto`: `direct` in the plane as long as the factor fits into memory and in space up to 5,000 points, and where the iteration cannot; `iterative` beyond.
- `direct`: With a factor of the matrix.
- `iterative`: By conjugate gradients without a matrix, for positive definite stiffness."""
    tolerance: float
    """Force that the iteration leaves out of balance after a breakage, relative to the forces that may act at a point: 1e-8. Bonds that
are nearer to each other than a hundred times this, relatively, break together."""
    factorisation: Literal["auto", "llt", "ldlt"]
    """The factorisation of the stiffness.

- `auto`: `llt` where every bond has a positive shear stiffness, `ldlt` otherwise.
- `llt`: L L^T, for positive definite stiffness.
- `ldlt`: L D L^T, also for indefinite stiffness. Default "auto"."""
    ordering: Literal["auto", "nested-dissection", "minimum-degree"]
    """The order of elimination.

- `auto`: `nested-dissection` from 2,000 points on, `minimum-degree` below.
- `nested-dissection`: Nested dissection of the graph of the matrix.
- `minimum-degree`: Approximate minimum degree of the unknowns. Default "auto"."""
    update: Literal["auto", "incremental", "refactor"]
    """What happens to the factor when bonds break.

- `auto`: `incremental`.
- `incremental`: The factor is changed in place, unless so many bonds break at once that making it anew costs less.
- `refactor`: The factor is made anew every time. Default "auto"."""
    rebuild_every: int
    """Broken bonds between two factors that are made anew."""
    threads: int
    """Threads; without it one for each processor. Results do not depend on it."""
    memory: float
    """Memory that a run may take, GB; without it what the machine has left. A run that would take more is refused; where the method is
open, bodies in the plane whose factor does not fit are solved without a matrix."""


class Output(TypedDict, total=False):
    """Files that a run writes."""

    fields_every: int
    """Load steps or rows of a motion (default 10) or events of the exact path (100) between two field files; 0: the first and the last state alone."""
    during_breakage: int
    """Largest number of states between the breakages of a load step with field files of their own, evenly spread over its breakages: the growth of a
crack that runs within one step. Default 0."""
    bonds: bool
    """Whether the bonds are written as lines with each field file. Default false."""
    model: bool
    """Whether `model.vtu` is written, which `ligament explain` reads. Default true."""
    checkpoint_every: float
    """Time between two checkpoints, from which `ligament resume` goes on, s; without it half a minute, and so long that they take
a fiftieth of the time. 0: only when the run is stopped."""
    picture: bool
    """Whether a picture of the last state, with its damage or displacement, and one of the curve of force over displacement are drawn
at the end. Default false."""
    stress: Sequence[Literal["material", "effective", "virial", "traction"]]
    """Stresses at the points in the field files. Default []."""


class SectionsOnBody(TypedDict, total=False):
    """The sections of a case without its body."""

    title: str
    """One line on what the case is. Default ""."""
    analysis: Literal["static", "fracture", "modal", "motion"]
    """Kind of analysis; without it `motion` where there is a `[motion]` section, `fracture` where there is a `[fracture]` section, else
`static`.

- `static`: One linear elastic solution at load factor 1.
- `fracture`: The breaking of bonds under rising loads.
- `modal`: Natural frequencies and modes.
- `motion`: A motion in time, in which bonds break where `[fracture]` has criteria."""
    curve: str
    """Name of the load, `temperature`, or name of the rigid body that is the axis of the force-displacement curve; without it the first load,
otherwise the temperature, otherwise the first rigid body that moves."""
    material: Material | Mapping[str, MaterialPart]
    """The material of the whole body; or a table `[material.NAME]` with a `group` for each of several."""
    interface: Sequence[Interface]
    """Interfaces between two materials with strengths of their own."""
    model: Model
    """The bond model."""
    correction: Correction
    """The corrections of the bonds; without it as in the paper of the law."""
    precrack: Sequence[Precrack]
    """Cracks and slots that are there from the start."""
    support: Sequence[Support]
    """Supports of the body, which needs none."""
    load: Sequence[Load]
    """Loads as they are at load factor 1; the first is the axis of the force-displacement curve."""
    stage: Sequence[Stage]
    """Stages one after the other, in which each load follows a factor of its own; without any all grow with one load factor."""
    temperature: Sequence[Temperature]
    """Changes of temperature at load factor 1; where several apply, the last one counts."""
    initial_velocity: Sequence[InitialVelocity]
    """Velocities at time zero of a motion."""
    quiet: Sequence[Quiet]
    """Parts of the outline through which waves leave the body in a motion."""
    contact: Sequence[Contact]
    """Contact between parts of the body."""
    rigid: Sequence[Rigid]
    """Rigid bodies that parts of the body meet."""
    far_field: FarField
    """Linear finite elements in place of bonds, away from parts of a meshed body."""
    refine: Refine
    """Runs one after the other, each from the unloaded body, on meshes that are finer where bonds of the runs before broke."""
    no_fail: Sequence[NoFail]
    """Parts of the body where bonds never break."""
    probe: Sequence[Probe]
    """Extra columns of `history.csv`."""
    fracture: Fracture
    """How bonds break; without it the case is one linear elastic solution."""
    modal: Modal
    """Requested natural modes, with `analysis = "modal"`."""
    motion: Motion
    """A motion in time under loads that depend on time."""
    solver: Literal["auto"] | Solver
    """Solution of the equations; all keys are optional."""
    output: Output
    """Files that a run writes."""


class Mesh(TypedDict, total=False):
    """The body, meshed by Gmsh; or a `[lattice]`."""

    file: str | PathLike[str]
    """The mesh, a Gmsh file (2.2 or 4.1), or a table of points (`.csv`), from the folder of the case file."""
    scale: float
    """Factor on the coordinates of the mesh, such as 1e-3 for a mesh in mm; lengths elsewhere in the case stay in m. Default 1.0."""
    coordinates: Literal["xy", "xz", "yz"]
    """Plane in which a mesh without solid cells lies; from another one than that of x and y it is turned, and the case has the turned x and y.

- `xy`: The plane of x and y.
- `xz`: The plane of x and z: z becomes y.
- `yz`: The plane of y and z: y becomes x, and z becomes y. Default "xy"."""
    thickness: float
    """Thickness of a body in the plane, m; a mesh of solid cells has none. Default 1.0."""
    plane: Literal["stress", "strain"]
    """Plane stress or plane strain of a body in the plane; a mesh of solid cells has none.

- `stress`: No stress out of the plane: thin bodies.
- `strain`: No strain out of the plane: long bodies. Default "stress"."""


class LatticeRemoveCircle(TypedDict, total=False):
    """A disk, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class LatticeRemoveOutside(TypedDict, total=False):
    """Everything outside of a disk, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class LatticeRemove(TypedDict, total=False):
    """A hole: cells whose centre lies in it are removed."""

    name: str
    """Name of the `group` of the cells at its rim; several holes may share it."""
    circle: LatticeRemoveCircle
    """A disk, m."""
    rectangle: Sequence[Numbers]
    """A rectangle by two opposite corners, m."""
    polygon: Sequence[Numbers]
    """A polygon by its corners, three or more, m."""
    outside: LatticeRemoveOutside
    """Everything outside of a disk, m."""


class LatticeSetCircle(TypedDict, total=False):
    """Cells whose centre lies in a disk, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class LatticeSet(TypedDict, total=False):
    """A set of cells."""

    bottom: int
    """Number of rows from the bottom."""
    top: int
    """Number of rows from the top."""
    left: int
    """Number of columns from the left."""
    right: int
    """Number of columns from the right."""
    box: Sequence[Numbers]
    """Cells whose centre lies in a rectangle, by two opposite corners, m."""
    circle: LatticeSetCircle
    """Cells whose centre lies in a disk, m."""
    polygon: Sequence[Numbers]
    """Cells whose centre lies in a polygon, by its corners, three or more, m."""


class Lattice(TypedDict, total=False):
    """The body as a rectangle of equal cells with a point at the centre of each; or a `[mesh]`."""

    cells: Sequence[int]
    """Number of cells along x and y."""
    spacing: float | Numbers
    """Side of the cells, or their sides `[dx, dy]`, m."""
    corner: Numbers
    """Lower left corner of the lattice, m. Default [0.0,0.0]."""
    thickness: float
    """Thickness of the body, m. Default 1.0."""
    plane: Literal["stress", "strain"]
    """Plane stress or plane strain.

- `stress`: No stress out of the plane: thin bodies.
- `strain`: No strain out of the plane: long bodies. Default "stress"."""
    remove: Sequence[LatticeRemove]
    """Holes: cells whose centre lies in one are removed, and bonds across it."""
    set: Mapping[str, LatticeSet]
    """Named sets of cells, which stand wherever a `group` does."""


class SolidLatticeRemoveSphere(TypedDict, total=False):
    """A ball, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class SolidLatticeRemoveCylinder(TypedDict, total=False):
    """A cylinder with flat ends, m."""

    ends: Sequence[Numbers]
    """Middles of its two ends, m."""
    radius: float
    """Radius, m."""


class SolidLatticeRemoveOutsideSphere(TypedDict, total=False):
    """Everything outside of a ball, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class SolidLatticeRemoveOutsideCylinder(TypedDict, total=False):
    """Everything outside of an infinite cylinder, m."""

    ends: Sequence[Numbers]
    """Middles of its two ends, m."""
    radius: float
    """Radius, m."""


class SolidLatticeRemove(TypedDict, total=False):
    """A hole: cells whose centre lies in it are removed."""

    name: str
    """Name of the `group` of the cells at its surface; several holes may share it."""
    sphere: SolidLatticeRemoveSphere
    """A ball, m."""
    cylinder: SolidLatticeRemoveCylinder
    """A cylinder with flat ends, m."""
    box: Sequence[Numbers]
    """A box by two opposite corners `[[x, y, z], [x, y, z]]`, m."""
    outside_sphere: SolidLatticeRemoveOutsideSphere
    """Everything outside of a ball, m."""
    outside_cylinder: SolidLatticeRemoveOutsideCylinder
    """Everything outside of an infinite cylinder, m."""


class SolidLatticeSetSphere(TypedDict, total=False):
    """Cells whose centre lies in a ball, m."""

    centre: Numbers
    """Centre, m."""
    radius: float
    """Radius, m."""


class SolidLatticeSetCylinder(TypedDict, total=False):
    """Cells whose centre lies in a cylinder, m."""

    ends: Sequence[Numbers]
    """Middles of its two ends, m."""
    radius: float
    """Radius, m."""


class SolidLatticeSet(TypedDict, total=False):
    """A set of cells."""

    left: int
    """Number of layers from the lowest x."""
    right: int
    """Number of layers from the highest x."""
    front: int
    """Number of layers from the lowest y."""
    back: int
    """Number of layers from the highest y."""
    bottom: int
    """Number of layers from the lowest z."""
    top: int
    """Number of layers from the highest z."""
    box: Sequence[Numbers]
    """Cells whose centre lies in a box, by two opposite corners, m."""
    sphere: SolidLatticeSetSphere
    """Cells whose centre lies in a ball, m."""
    cylinder: SolidLatticeSetCylinder
    """Cells whose centre lies in a cylinder, m."""


class SolidLattice(TypedDict, total=False):
    """The body as a box of equal cells in space with a point at the centre of each; or a `[mesh]` of solid cells."""

    cells: Sequence[int]
    """Number of cells along x, y and z."""
    spacing: Numbers
    """Sides of the cells `[dx, dy, dz]`, m."""
    corner: Numbers
    """Corner of the box with the lowest coordinates, m. Default [0.0,0.0,0.0]."""
    remove: Sequence[SolidLatticeRemove]
    """Holes: cells whose centre lies in one are removed, and bonds across it."""
    set: Mapping[str, SolidLatticeSet]
    """Named sets of cells, which stand wherever a `group` does."""


class Sections(SectionsOnBody, total=False):
    """The sections of a case."""

    mesh: Mesh
    """The body, meshed by Gmsh; or a `[lattice]`."""
    lattice: Lattice
    """The body as a rectangle of equal cells with a point at the centre of each; or a `[mesh]`."""
    solid_lattice: SolidLattice
    """The body as a box of equal cells in space with a point at the centre of each; or a `[mesh]` of solid cells."""
