// The lab's page for self-tests, with internal names as globals.
import '../../../report/page/lab_page';

import * as engine from '../../../report/page/lab/engine';
import * as experiments from '../../../report/page/lab/experiments';
import * as guide from '../../../report/page/lab/guide';
import * as knobs from '../../../report/page/lab/knobs';
import * as lab from '../../../report/page/lab/lab';
import * as labRuns from '../../../report/page/lab/lab_runs';
import * as liveRun from '../../../report/page/lab/live_run';
import * as sceneText from '../../../report/page/lab/scene_text';
import * as words from '../../../report/page/lab/words';
import * as controls from '../../../report/page/player/controls';
import * as player from '../../../report/page/player/player';

for (const module of [experiments, engine, guide, knobs, lab, labRuns, liveRun, sceneText, words, controls, player])
  for (const name of Object.keys(module))
    Object.defineProperty(globalThis, name, {get: () => (module as Record<string, unknown>)[name], configurable: true});
