//! Finds an installed libmlcp, or builds the one in `vendor`; makes the bindings afresh where that was asked for.
use std::env;
use std::error::Error;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "bindgen")]
    bindings::generate()?;
    // documentation needs no library
    println!("cargo::rerun-if-env-changed=DOCS_RS");
    if env::var_os("DOCS_RS").is_some() {
        return Ok(());
    }
    library::link()
}

#[cfg(not(feature = "vendored"))]
mod library {
    use std::env;
    use std::error::Error;

    /// Links the libmlcp that pkg-config knows. Before 1.0 a minor version may break the ABI, so the next one is too new.
    pub fn link() -> Result<(), Box<dyn Error>> {
        let version = env::var("CARGO_PKG_VERSION")?;
        let major: u32 = env::var("CARGO_PKG_VERSION_MAJOR")?.parse()?;
        let minor: u32 = env::var("CARGO_PKG_VERSION_MINOR")?.parse()?;
        let next = if major == 0 { format!("0.{}", minor + 1) } else { format!("{}", major + 1) };
        let library =
            pkg_config::Config::new().range_version(version.as_str()..next.as_str()).probe("mlcp").map_err(|error| {
                format!("no libmlcp from {version} up to below {next} found; the feature `vendored` builds one\n{error}")
            })?;
        for folder in &library.include_paths {
            println!("cargo::metadata=include={}", folder.display());
        }
        Ok(())
    }
}

#[cfg(feature = "vendored")]
mod library {
    use std::env;
    use std::error::Error;
    use std::path::Path;

    /// Builds and links the static library. It is made as for a release whatever the profile: the same bits, and no wait.
    pub fn link() -> Result<(), Box<dyn Error>> {
        for part in ["CMakeLists.txt", "VERSION", "capi", "cmake", "core"] {
            println!("cargo::rerun-if-changed=vendor/{part}");
        }
        let out =
            cmake::Config::new("vendor").profile("Release").define("MLCP_BUILD_CLI", "OFF").build_target("mlcp_static").build();
        println!("cargo::rustc-link-search=native={}", out.join("build/lib").display());
        println!("cargo::rustc-link-lib=static=mlcp");
        println!("cargo::rustc-link-lib=z");
        println!("cargo::rustc-link-lib={}", if env::var("CARGO_CFG_TARGET_VENDOR")? == "apple" { "c++" } else { "stdc++" });
        println!("cargo::metadata=include={}", Path::new(&env::var("CARGO_MANIFEST_DIR")?).join("vendor/capi").display());
        Ok(())
    }
}

#[cfg(feature = "bindgen")]
mod bindings {
    use std::env;
    use std::error::Error;
    use std::fs;
    use std::path::Path;

    /// Rust of mlcp.h. Enumerators stay constants: a value that a newer library returns must not be undefined behaviour.
    pub fn generate() -> Result<(), Box<dyn Error>> {
        const HEADER: &str = "vendor/capi/mlcp.h";
        println!("cargo::rerun-if-changed={HEADER}");
        let bindings = bindgen::Builder::default()
            .header(HEADER)
            .allowlist_item("(mlcp|MLCP)_.*")
            .default_enum_style(bindgen::EnumVariation::Consts)
            .prepend_enum_name(false)
            .default_macro_constant_type(bindgen::MacroTypeVariation::Signed)
            .rust_target(bindgen::RustTarget::stable(85, 0).map_err(|error| error.to_string())?)
            .rust_edition(bindgen::RustEdition::Edition2024)
            .use_core()
            .derive_default(false)
            .merge_extern_blocks(true)
            .formatter(bindgen::Formatter::Prettyplease)
            .disable_header_comment()
            .generate()?
            .to_string();
        fs::write(Path::new(&env::var("OUT_DIR")?).join("bindings.rs"), typed_constants(&bindings))?;
        Ok(())
    }

    /// mlcp.h writes `typedef int32_t mlcp_x; enum { … };`, where C has no link between the two and bindgen makes the constants of
    /// a type of their own. Here they are of the type that stands before them.
    fn typed_constants(bindings: &str) -> String {
        let mut typed = String::new();
        let mut last_type = "";
        for line in bindings.lines() {
            let alias = line.strip_prefix("pub type ").and_then(|rest| rest.split(" = ").next());
            match alias {
                Some(name) if name.starts_with("_bindgen_ty_") => continue,
                Some(name) => last_type = name,
                None => (),
            }
            match line.split_once(": _bindgen_ty_").and_then(|(name, rest)| Some((name, rest.split_once(" = ")?.1))) {
                Some((name, value)) => typed += &format!("{name}: {last_type} = {value}\n"),
                None => typed += &format!("{line}\n"),
            }
        }
        typed
    }
}
