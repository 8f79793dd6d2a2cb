// Contains no code: the headers that the rooms above mysim share are precompiled once, for this target.
