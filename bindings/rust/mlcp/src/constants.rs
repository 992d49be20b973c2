//! Rust enums of the library's integer constants.

/// Defines an enum and its way to and from the library's number. A number that only a newer library knows becomes `Unknown`.
macro_rules! constants {
    ($(#[$doc:meta])* $name:ident, $raw:ty { $($(#[$value_doc:meta])* $value:ident = $constant:ident,)+ }) => {
        $(#[$doc])*
        #[non_exhaustive]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name {
            $($(#[$value_doc])* $value,)+
            /// A value that only a newer library knows.
            Unknown($raw),
        }

        impl $name {
            #[allow(dead_code)] // some only come out of the library, some only go in
            pub(crate) fn from_raw(raw: $raw) -> Self {
                match raw {
                    $(sys::$constant => Self::$value,)+
                    _ => Self::Unknown(raw),
                }
            }

            #[allow(dead_code)]
            pub(crate) fn raw(self) -> $raw {
                match self {
                    $(Self::$value => sys::$constant,)+
                    Self::Unknown(raw) => raw,
                }
            }
        }
    };
}
pub(crate) use constants;
