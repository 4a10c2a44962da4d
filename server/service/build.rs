//! The page is embedded at build time: a file added to it must rebuild the crate.

fn main() {
    println!("cargo:rerun-if-changed=../../web");
}
