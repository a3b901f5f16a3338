//! Lets the module be linked without Python on systems that want to be told so (macOS).

fn main() {
    pyo3_build_config::add_extension_module_link_args();
}
