fn misuse() -> mlcp::Contacts<'static> {
    let mu = vec![0.5, 0.5];
    mlcp::Contacts::spatial(2).mu(&mu)
}

fn main() {
    misuse();
}
