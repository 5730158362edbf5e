import { render } from 'preact';
import { onKey } from './state/actions';
import { start } from './state/store';
import './style/tokens.css';
import './style/base.css';
import './style/page.css';
import './style/bridge.css';
import './style/tables.css';
import { App } from './view/app';

render(<App />, document.getElementById('page')!);
document.addEventListener('keydown', onKey);
void start();
