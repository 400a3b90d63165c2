// Nothing: the precompiled header of the tests needs a source to be compiled with.
