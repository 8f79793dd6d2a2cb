// Only the engine of the lab, for Node.
import {labModule} from '../../../report/page/lab/engine';

Object.assign(globalThis, {labModule});
