//! Runs that a caller advances row by row, compared with runs that advance by themselves.
#![allow(clippy::unwrap_used)]

use ligament::Loading;
use ligament::analysis::driver::{Outcome, Stop};
use ligament::analysis::motion::{MotionSettings, Scheme};
use ligament::prelude::*;
use ligament::run::{Posed, begin, follow};
use ligament::setup::InitialVelocity;

use crate::examples::watched_plate::plate;

/// The plate of the example under another analysis.
fn plate_under(analysis: Analysis) -> Model {
    let mut setup = plate().unwrap();
    if matches!(analysis, Analysis::Motion(_)) {
        for region in &mut setup.materials {
            region.material.density = Some(2400.0);
        }
        setup.loads.clear();
        setup.initial_velocities = vec![InitialVelocity {
            place: Place::Group("top".into()),
            velocity: [0.0, 2.0, 0.0],
        }];
    }
    setup.analysis = analysis;
    Model::build(setup, &mut ()).unwrap()
}

/// The outcome of a run whose rows are requested one by one.
fn by_hand(posed: Posed<'_>, analysis: &Analysis) -> Outcome {
    let mut observer = NoObserver;
    let mut way = begin(posed, analysis, &mut observer).unwrap();
    let mut rows = 0;
    loop {
        match way.advance() {
            Ok(()) => {
                // Along the exact path the equilibrium is one event ahead of its record.
                assert!(way.history().len() > rows);
                rows = way.history().len();
            }
            Err(Stop::End(end)) => return way.outcome(end).unwrap(),
            Err(Stop::Failed(error)) => panic!("{error}"),
        }
    }
}

#[test]
fn a_run_by_hand_has_the_bits_of_one_that_follows_itself() {
    let motion = |scheme| MotionSettings {
        scheme,
        rows: 20,
        step: (scheme != Scheme::Explicit).then_some(1e-6),
        ..MotionSettings::new(2e-5)
    };
    let analyses = [
        Analysis::Elastic {
            energy_tolerance: 1e-4,
        },
        Analysis::Stepped(stepped(vec![0.3, 0.6, 0.8])),
        Analysis::Event(event()),
        Analysis::Motion(motion(Scheme::Explicit)),
        Analysis::Motion(motion(Scheme::Implicit)),
    ];
    for analysis in analyses {
        let model = plate_under(analysis);
        let analysis = &model.setup.analysis;
        let loading = Loading::new(&model).unwrap();
        let problem = loading.problem(&model);
        let moving = loading.motion(&problem);
        let posed = Posed::new(&problem, moving.as_ref());
        let followed = follow(posed, analysis, &mut NoObserver).unwrap();
        let advanced = by_hand(posed, analysis);
        assert!(followed.history.len() > 1, "{}", analysis.name());
        assert_eq!(advanced.history, followed.history, "{}", analysis.name());
        assert_eq!(advanced.state, followed.state, "{}", analysis.name());
        assert_eq!(advanced.termination, followed.termination);
    }
}
