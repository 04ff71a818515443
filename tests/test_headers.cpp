// Nothing: the target's precompiled header is all that is wanted of it, and a target needs a source.
