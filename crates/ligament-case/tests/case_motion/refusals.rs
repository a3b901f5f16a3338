//! Settings that a motion refuses.

/// Settings of the bar, and what the error says about them.
pub(super) const REFUSED: [[&str; 2]; 49] = [
    [
        "-material.density",
        "material.density: missing key `density`: it is required (in kg/m^3) because a motion needs masses",
    ],
    [
        "-motion.duration",
        "motion.duration: missing key `duration` in [motion] (in s)",
    ],
    [
        "motion.duration=0",
        "motion.duration: must be greater than 0, found 0.0",
    ],
    [
        "motion.safety=1.0",
        "motion.safety: must be greater than 0 and less than 1, found 1.0",
    ],
    [
        "motion.rows=0",
        "motion.rows: must be 1 to 1000000, found 0",
    ],
    [
        "motion.statics=1e-3",
        "motion.statics: `statics` does not apply with scheme = \"explicit\"",
    ],
    [
        "motion={duration=1.0,scheme=\"implicit\",step=1e-7,statics=1e-3}",
        "motion.statics: `statics` does not apply with scheme = \"implicit\": all implicit steps have inertia",
    ],
    [
        "motion={duration=1.0,scheme=\"auto\",step=1e-7,statics=1.0}",
        "motion.statics: must be greater than 0 and less than 1, found 1.0",
    ],
    [
        "motion={duration=1.0,scheme=\"auto\"}",
        "motion.step: missing key `step`",
    ],
    [
        "motion.step=-1e-9",
        "motion.step: must be greater than 0, found -1e-9",
    ],
    [
        "motion.damping.mass=-1.0",
        "motion.damping.mass: must be at least 0: a negative damping would feed energy to the body, found -1.0",
    ],
    [
        "motion.damping.stiffness=-1.0",
        "motion.damping.stiffness: must be at least 0",
    ],
    [
        "motion.rotary_inertia=0.0",
        "motion.rotary_inertia: must be greater than 0",
    ],
    [
        "motion.stop.bonds=0",
        "motion.stop.bonds: must be at least 1",
    ],
    ["motion.scheme=implicid", "unknown value \"implicid\""],
    [
        "analysis=static",
        "motion: `motion` does not apply with analysis = \"static\"",
    ],
    [
        "stage=[{loads={left=1.0}}]",
        "stage: `stage` does not apply with analysis = \"motion\": each load follows an `amplitude`",
    ],
    [
        "temperature=[{change=5.0}]",
        "temperature: `temperature` does not apply with analysis = \"motion\"",
    ],
    [
        "solver.method=direct",
        "solver.method: `method` does not apply with motion.scheme = \"explicit\": explicit steps solve no equations; remove it",
    ],
    [
        "solver.update=refactor",
        "solver.update: `update` does not apply",
    ],
    [
        "solver.rebuild_every=5",
        "solver.rebuild_every: `rebuild_every` does not apply",
    ],
    [
        "fracture.steps=10",
        "fracture.steps: `steps` does not apply with analysis = \"motion\": a motion has no load steps",
    ],
    [
        "fracture.control=event",
        "fracture.control: `control` does not apply",
    ],
    [
        "fracture.tie_tolerance=1e-8",
        "fracture.tie_tolerance: `tie_tolerance` does not apply",
    ],
    [
        "fracture.stop.bonds=3",
        "fracture.stop: `stop` does not apply with analysis = \"motion\": a motion has a `stop` of its own, in [motion]",
    ],
    ["-load", "the case has no [[load]] section"],
    ["model.closing_friction=0.3", "model.closing_friction: "],
    [
        "load.0.amplitude={points=[[0,0],[2,1],[1,0]]}",
        "load.0.amplitude.points.2.0: must be a time later than that of the point before, 2.0 s, found 1.0",
    ],
    [
        "load.0.amplitude={points=[]}",
        "load.0.amplitude.points: must be one point or more",
    ],
    [
        "load.0.amplitude={shape=\"half-sine\"}",
        "missing key `duration`",
    ],
    [
        "load.0.amplitude={shape=\"half-sine\",duration=0.0}",
        "load.0.amplitude.duration: must be greater than 0",
    ],
    [
        "load.0.amplitude={shape=\"half-sine\",start=-1.0,duration=1.0}",
        "load.0.amplitude.start: must be at least 0",
    ],
    [
        "load.0.amplitude={shape=\"half-sine\",duration=1.0,periods=2}",
        "load.0.amplitude.periods: `periods` does not apply with shape = \"half-sine\"",
    ],
    [
        "load.0.amplitude={shape=\"ricker\",duration=1.0}",
        "`duration` does not apply with shape = \"ricker\": a wavelet has a `peak_time` and a `frequency`",
    ],
    [
        "load.0.amplitude={shape=\"ricker\",peak_time=1.0}",
        "missing key `frequency`",
    ],
    [
        "load.0.amplitude={points=[[0,0]],duration=1.0}",
        "`duration` does not apply with `points` or `file`",
    ],
    [
        "load.0.amplitude={points=[[0,0]],shape=\"ramp\"}",
        "needs exactly one of `points`, `file`, `shape`",
    ],
    [
        "load.0.amplitude={file=\"missing.csv\"}",
        "load.0.amplitude.file: cannot read",
    ],
    [
        "load.0={group=\"left\",displacement={x=1e-6}}",
        "load.0.displacement: the points would jump at time zero: give the load an `amplitude` that begins at 0, or a `velocity`",
    ],
    [
        "load.0={group=\"left\",displacement={x=1e-6},amplitude={shape=\"rectangle\",duration=1e-6}}",
        "load.0.amplitude: the points would jump",
    ],
    [
        "load.0={group=\"left\",force={x=1.0},tilts=true}",
        "load.0.tilts: a platen is so stiff",
    ],
    [
        "support=[{group=\"right\",normal=[1,1]}]",
        "support.0.normal: an inclined roller is held by springs so stiff",
    ],
    [
        "quiet=[{group=\"rigth\"}]",
        "quiet.0.group: no set of the lattice is called `rigth`; did you mean `right`?",
    ],
    ["quiet=[{}]", "quiet.0.group: missing key `group`"],
    [
        "initial_velocity=[{group=\"middle\",velocity={x=1.0}}]",
        "initial_velocity.0.group: no set of the lattice is called `middle`",
    ],
    [
        "initial_velocity=[{velocity={z=1.0}}]",
        "initial_velocity.0.velocity.z: a body in the plane has no z",
    ],
    ["initial_velocity=[{}]", "missing key `velocity`"],
    [
        "load.0={group=\"left\",velocity={z=1.0}}",
        "load.0.velocity",
    ],
    [
        "load.0={group=\"left\",velocity={}}",
        "load.0.velocity: needs one of `x`, `y`, `rotation` or more",
    ],
];
