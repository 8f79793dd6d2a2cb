// No code: precompiles the headers that the rooms above mysim share, once for this target.
