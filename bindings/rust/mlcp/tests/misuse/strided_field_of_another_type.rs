use mlcp::{Strided, strided};

struct Contact {
    gap: Box<f64>,
}

fn main() {
    let contacts = [Contact { gap: Box::new(0.0) }];
    let gaps: Strided<'_, f64> = strided!(&contacts, Contact, gap);
    println!("{}", gaps.len());
}
