struct Contact {
    gap: Box<f64>,
}

fn misuse(contacts: &[Contact]) -> mlcp::Strided<'_, f64> {
    mlcp::strided!(contacts, Contact, gap)
}

fn main() {}
