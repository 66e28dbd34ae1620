//! Many hops at once.
