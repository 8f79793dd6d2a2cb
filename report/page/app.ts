// Entry point of the report's page: players, lab, charts and folds.
import {startGuide} from './lab/guide';
import {startLab} from './lab/lab';
import {startPage} from './page';
import {startPlayers} from './player/player';
import {startRuns} from './player/runs';

startPlayers();
startRuns();
startLab();
startGuide();
startPage();
