//! A plate with an edge crack, pulled by hand: the program requests each load step, chooses the next load by the bonds that broke, and
//! stops the run when the crack has run through half of the plate.

#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

#[path = "watched_plate.rs"]
#[allow(dead_code, reason = "its plate is pulled here, without its watch")]
mod watched_plate;

use ligament::Loading;
use ligament::analysis::driver::stepped::begin;
use ligament::analysis::driver::{Stop, Way};
use ligament::prelude::*;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let model = Model::build(watched_plate::plate()?, &mut ())?;
    let problem = Loading::new(&model)?.problem(&model);
    let Analysis::Stepped(settings) = &model.setup.analysis else {
        return Err("the plate is pulled in load steps".into());
    };
    let mut observer = NoObserver;
    let mut steps = begin(&problem, settings, &mut observer)?;
    let mut load_factor = 0.0;
    loop {
        steps.set_next_load_factor(load_factor);
        match steps.advance() {
            Ok(()) => {}
            Err(Stop::End(end)) => return Err(format!("it ended before: {end}").into()),
            Err(Stop::Failed(error)) => return Err(error.into()),
        }
        let last = steps.history().last().ok_or("a step has a record")?;
        let (broken, force) = (last.broken_in_step, last.reaction);
        println!("{load_factor:.4}: {force:.4e} N, {broken} bonds broke");
        // The next step is long where nothing broke, and short after a breakage.
        load_factor += if broken == 0 { 0.05 } else { 0.005 };
        if steps.state().broken_bonds() >= 200 {
            break;
        }
    }
    let longest = (steps.state().displacement.iter()).fold(0.0, |most: f64, it| most.max(it.abs()));
    println!("the plate moved by {longest:.3e} m");
    assert!(longest > 0.0 && load_factor < 1.0);
    Ok(())
}
