// No code: the headers that the rooms above mysim share are read once, for this target.
