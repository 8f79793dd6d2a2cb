// Entry point of the page that contains only the lab.
import {startGuide} from './lab/guide';
import {startLab} from './lab/lab';
import {startPlayers} from './player/player';

startPlayers();
startLab();
startGuide();
