//! Lists with names: every item has its place, its name in files and in the C ABI, and its meaning from one definition.

/// Defines an enumeration whose items are places in a list of names.
macro_rules! registry {
    (
        $(#[$about:meta])*
        $vis:vis enum $item:ident, $(#[$about_list:meta])* $list_vis:vis const $list:ident {
            $( $(#[$doc:meta])* $variant:ident = $name:literal ),+ $(,)?
        }
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $item { $( $(#[$doc])* $variant ),+ }

        $(#[$about_list])*
        $list_vis const $list: [&str; [$($name),+].len()] = [$($name),+];

        impl $item {
            #[allow(dead_code, reason = "not every list is gone through")]
            /// All of them, in order.
            $vis const ALL: [Self; $list.len()] = [$(Self::$variant),+];

            #[allow(dead_code, reason = "not every list is one of the C ABI")]
            /// Their names in C.
            pub(crate) const C_NAMES: [&std::ffi::CStr; $list.len()] =
                [$($crate::registry::c_name(concat!($name, "\0"))),+];

            #[allow(dead_code, reason = "not every list needs it")]
            /// Its name.
            $vis const fn name(self) -> &'static str {
                $list[self as usize]
            }
        }
    };
}

/// A text that ends with NUL and has no other.
pub(crate) const fn c_name(text: &str) -> &std::ffi::CStr {
    match std::ffi::CStr::from_bytes_with_nul(text.as_bytes()) {
        Ok(name) => name,
        Err(_) => c"",
    }
}

pub(crate) use registry;
