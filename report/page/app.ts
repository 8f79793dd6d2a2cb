// Entry point of the report's page.
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
