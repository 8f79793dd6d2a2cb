// The lab's engine only, for Node.
import {labModule} from '../../../report/page/lab/engine';

Object.assign(globalThis, {labModule});
