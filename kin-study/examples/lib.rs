//! Studies, each a complete program in a file of its own; the tests of this package run them.
