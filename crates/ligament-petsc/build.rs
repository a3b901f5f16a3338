//! Compiles the C file against PETSc and MPI of the system, with the feature `petsc`; does nothing without it.

fn main() {
    #[cfg(feature = "petsc")]
    library::compile();
}

#[cfg(feature = "petsc")]
mod library {
    #![allow(
        clippy::print_stdout,
        reason = "a build script speaks to Cargo through its output"
    )]

    /// The C source of the crate.
    const SOURCE: &str = "src/petsc.c";

    /// Names under which systems list an MPI for C.
    const MPI: [&str; 3] = ["ompi-c", "mpich", "mpi-c"];

    pub(super) fn compile() {
        println!("cargo::rerun-if-changed={SOURCE}");
        let petsc = pkg_config::Config::new()
            .atleast_version("3.18")
            .probe("PETSc");
        let petsc = petsc.unwrap_or_else(|reason| {
            panic!(
                "PETSc was not found ({reason}): on Debian run tools/install-petsc, elsewhere let PKG_CONFIG_PATH name the folder of \
                 PETSc.pc, or build without the feature petsc"
            )
        });
        let mpi = MPI
            .iter()
            .find_map(|name| pkg_config::probe_library(name).ok());
        let mut build = cc::Build::new();
        build.file(SOURCE).includes(&petsc.include_paths);
        if let Some(mpi) = mpi {
            build.includes(&mpi.include_paths);
        }
        build.warnings(true).compile("ligament_petsc");
        // After the file that needs them: linkers search from left to right.
        for name in &petsc.libs {
            println!("cargo::rustc-link-lib={name}");
        }
    }
}
