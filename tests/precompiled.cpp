// The library of precompiled headers must have a file.
