// Contains no code: this target precompiles the headers shared by the modules above mysim, so that each is compiled
// only once.
