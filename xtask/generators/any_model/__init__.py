"""The checker's knowledge of certificates of any model: formulas, flows, events and statements in ball arithmetic."""
