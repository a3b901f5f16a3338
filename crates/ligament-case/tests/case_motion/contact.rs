//! `[[contact]]` and `[[rigid]]`: what they make, and what is refused.

use ligament::setup::RigidForm;
use ligament_analysis::contact::RigidMotion;
use ligament_analysis::{Amplitude, Shape};

use super::{BAR, motion, read};

/// Settings of the bar, and what the error says about them.
const REFUSED: [[&str; 2]; 22] = [
    [
        "contact=[{between=[\"left\",\"rigth\"]}]",
        "contact.0.between: no set of the lattice is called `rigth`; did you mean `right`?",
    ],
    [
        "contact=[{between=[\"left\",\"left\"]}]",
        "contact.0.between: contact is between two different groups",
    ],
    [
        "contact=[{}]",
        "contact.0.between: bonds connect the whole body",
    ],
    [
        "contact=[{friction=-0.1}]",
        "contact.0.friction: must be 0 or more, found -0.1",
    ],
    [
        "contact=[{stiffness=0.0}]",
        "contact.0.stiffness: must be greater than 0, found 0.0",
    ],
    ["contact=[{betwen=[\"left\",\"right\"]}]", "`betwen`"],
    [
        "rigid=[{name=\"it\",shape=\"circle\",centre=[0.005,0.003],radius=1.5e-3}]",
        "rigid.0: begins 5.000e-4 m deep inside the body, at cell ",
    ],
    [
        "rigid=[{name=\"it\",shape=\"sphere\",centre=[0.0,1.0],radius=0.1}]",
        "rigid.0.shape: a body in the plane meets a \"circle\"",
    ],
    [
        "rigid=[{name=\"it\",shape=\"circle\",centre=[0.0,1.0]}]",
        "rigid.0.radius: missing key `radius`",
    ],
    [
        "rigid=[{name=\"it\",shape=\"circle\",centre=[0.0,1.0],radius=-1.0}]",
        "rigid.0.radius: must be greater than 0, found -1.0",
    ],
    [
        "rigid=[{name=\"it\",shape=\"circle\",centre=[0.0,1.0],radius=0.1,normal=[0.0,1.0]}]",
        "rigid.0.normal: `normal` does not apply with shape = \"circle\"",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,0.0]}]",
        "rigid.0.normal: must be a direction other than [0, 0]",
    ],
    [
        "rigid=[{name=\"it\",shape=\"box\",centre=[0.0,1.0],size=[1.0,0.0]}]",
        "rigid.0.size: must be greater than 0, found 0.0",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],mass=-2.0}]",
        "rigid.0.mass: must be greater than 0, found -2.0",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],mass=2.0,amplitude={shape=\"ramp\",duration=1.0}}]",
        "rigid.0.amplitude: a body with a mass moves by itself",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],mass=2.0,inertia=1.0}]",
        "rigid.0.inertia: walls do not turn",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],acceleration={y=1.0}}]",
        "rigid.0.acceleration: its motion is prescribed",
    ],
    [
        "rigid=[{name=\"left\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0]}]",
        "rigid.0.name: `left` is a group or a contact",
    ],
    [
        "contact=[{between=[\"left\",\"right\"]},{between=[\"left\",\"right\"]}]",
        "contact.1.between: an earlier contact is between the same",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],against=[\"lef\"]}]",
        "rigid.0.against: no set of the lattice is called `lef`; did you mean `left`?",
    ],
    [
        "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0,0.0],normal=[0.0,1.0]}]",
        "rigid.0.centre: a body in the plane takes two coordinates",
    ],
    [
        "rigid=[{name=\"a,b\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0]}]",
        "rigid.0.name: must be a name without commas",
    ],
];

#[test]
fn contacts_are_refused_where_they_make_no_sense() {
    for [setting, expected] in REFUSED {
        let error = motion(BAR, &[setting]).err().unwrap_or_default();
        assert!(error.contains(expected), "{setting}\n{error}\n{expected}");
    }
    let twice = "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0]},{name=\"it\",shape=\"wall\",centre=[0.0,2e-3],normal=[0.0,-1.0]}]";
    let error = motion(BAR, &[twice]).err().unwrap();
    assert!(error.contains("rigid.1.name"), "{error}");
}

const FLOOR: &str = "rigid=[{name=\"it\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0]}]";

/// Implicit steps move a body with a mass, and refuse by its key what they do not do with it.
#[test]
fn implicit_steps_move_masses() {
    const IMPLICIT: [&str; 4] = [
        FLOOR,
        "motion.scheme=implicit",
        "motion.step=1e-7",
        "rigid.0.mass=1.0",
    ];
    assert!(motion(BAR, &IMPLICIT).is_ok());
    let ball = "rigid=[{name=\"it\",shape=\"circle\",centre=[0.0,-1.0],radius=0.5}]";
    for (settings, expected) in [
        (
            &["motion.scheme=auto"][..],
            "rigid.0.mass: a body with a mass that nothing holds",
        ),
        (
            &[ball, "rigid.0.mass=1.0", "rigid.0.inertia=1.0"],
            "rigid.0.inertia: a rigid body turns in explicit steps",
        ),
        (
            &[
                "material.fracture_energy=100.0",
                "fracture={criterion=[{kind=\"tension\",limit=1e-4,after=\"linear\"}]}",
            ],
            "rigid.0.mass: implicit steps move rigid bodies beside bonds that do not soften",
        ),
    ] {
        let settings = [&IMPLICIT[..], settings].concat();
        let error = motion(BAR, &settings).err().unwrap_or_default();
        assert!(error.contains(expected), "{error}");
    }
}

/// What moves a rigid body belongs to the analysis; the exact path has contact without friction and stages, and modes, laws without a symmetric
/// stiffness and controlled stages have none.
#[test]
fn each_analysis_says_what_contact_it_has() {
    const STATICS: [&str; 4] = [
        "-motion",
        "-load.0.velocity",
        "-load.0.amplitude",
        "load.0.force.x=1.0",
    ];
    const STEPS: &str = "fracture={steps=2,criterion=[{kind=\"tension\",limit=1.0}]}";
    const PATH: &str = "fracture={control=\"event\",criterion=[{kind=\"tension\",limit=1.0}]}";
    let refused = [
        (
            &[PATH, "rigid.0.friction=0.1"][..],
            "rigid.0.friction: what slides depends on the way",
        ),
        (
            &[PATH, "stage=[{loads={left=1.0}}]"],
            "rigid.0: the exact path through stages",
        ),
        (
            &[STEPS, "rigid.0.velocity.y=1.0"],
            "rigid.0.velocity: there is no time",
        ),
        (
            &[STEPS, "rigid.0.mass=1.0"],
            "rigid.0.mass: there is no time",
        ),
        (
            &[
                "fracture={criterion=[{kind=\"tension\",limit=1.0}]}",
                "rigid.0.displacement.y=1.0",
                "stage=[{loads={left=1.0},steps=2}]",
            ],
            "rigid.0.displacement: with stages",
        ),
    ];
    for (settings, expected) in refused {
        let settings: Vec<&str> = [&STATICS[..], &[FLOOR], settings].concat();
        let error = motion(BAR, &settings).err().unwrap_or_default();
        assert!(
            error.contains(expected),
            "{settings:?}\n{error}\n{expected}"
        );
    }
    let moves = [FLOOR, "rigid.0.displacement.y=1e-6"];
    let error = motion(BAR, &moves).err().unwrap_or_default();
    assert!(
        error.contains("rigid.0.displacement: a displacement grows"),
        "{error}"
    );
    let steps: Vec<&str> = [&STATICS[..], &moves, &[STEPS]].concat();
    let setup = read(BAR, &steps).unwrap().setup(&mut ()).unwrap();
    assert_eq!(setup.rigid_bodies[0].displacement, [0.0, 1e-6, 0.0]);
}

/// Inclined rollers are springs so stiff that explicit steps would be a thousand times shorter; implicit ones take them.
#[test]
fn inclined_rollers_go_with_implicit_steps() {
    let rollers = "support=[{group=\"right\",normal=[1.0,1.0]}]";
    let error = motion(BAR, &[rollers]).err().unwrap_or_default();
    assert!(
        error.contains("support.0.normal: an inclined roller"),
        "{error}"
    );
    let implicit = [rollers, "motion.scheme=implicit", "motion.step=1e-7"];
    assert!(motion(BAR, &implicit).is_ok());
}

#[test]
fn contacts_have_defaults() {
    let floor = "rigid=[{name=\"floor\",shape=\"wall\",centre=[0.0,0.0],normal=[0.0,1.0],velocity={y=2.0},amplitude={shape=\"ramp\",duration=1e-6}},{name=\"hammer\",shape=\"box\",centre=[0.005,0.004],size=[1e-3,2e-3],mass=0.5,friction=0.4,against=[\"right\"]}]";
    let settings = [
        floor,
        "contact=[{between=[\"left\",\"right\"],friction=0.3}]",
    ];
    let setup = read(BAR, &settings).unwrap().setup(&mut ()).unwrap();
    let contact = &setup.contacts[0];
    let groups = ["left", "right"].map(str::to_owned);
    assert_eq!(contact.between, Some(groups));
    assert_eq!((contact.friction, contact.stiffness), (0.3, 1.0));
    let RigidForm::Box { size, .. } = setup.rigid_bodies[1].form else {
        panic!("another shape");
    };
    assert_eq!(size, [1e-3, 2e-3, 0.0]);
    let problem = motion(BAR, &settings).unwrap().problem.contact;
    let names: Vec<&str> = problem.contacts.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["left-right", "floor", "hammer"]);
    let ramp = Amplitude::pulse(Shape::Ramp, 0.0, 1e-6);
    let driven = RigidMotion::Prescribed {
        velocity: [0.0, 2.0, 0.0],
        amplitude: ramp,
    };
    assert_eq!(problem.rigid_bodies[0].motion, driven);
    let free = RigidMotion::Free {
        mass: 0.5,
        inertia: f64::INFINITY,
        velocity: [0.0; 3],
        acceleration: [0.0; 3],
    };
    assert_eq!(problem.rigid_bodies[1].motion, free);
}
