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

            #[allow(dead_code, reason = "not every list needs it")]
            /// Its name.
            $vis const fn name(self) -> &'static str {
                $list[self as usize]
            }
        }
    };
}

pub(crate) use registry;
