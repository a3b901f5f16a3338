//! Lets the module be linked without Python on systems that need a flag for it (macOS).

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
