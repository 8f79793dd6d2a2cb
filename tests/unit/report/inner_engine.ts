// The lab's engine alone, as Node runs it.
import {labModule} from '../../../report/page/lab/engine';

Object.assign(globalThis, {labModule});
