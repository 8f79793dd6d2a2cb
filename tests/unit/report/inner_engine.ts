// Only the lab's engine, for Node.
import {labModule} from '../../../report/page/lab/engine';

Object.assign(globalThis, {labModule});
