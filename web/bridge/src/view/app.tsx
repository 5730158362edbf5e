import type { ComponentChildren } from 'preact';
import { needsToken, problem, view, type View } from '../state/store';
import { BridgeView } from './bridge/bridge_view';
import { Help } from './help';
import { InspectorView } from './inspector/inspector_view';
import { LinksView } from './links/links_view';
import { SignIn } from './links/sign_in';
import { PageFooter } from './page_footer';
import { PageHeader } from './page_header';
import { TimingView } from './timing/timing_view';

const contents: Record<View, () => ComponentChildren> = {
  bridge: BridgeView,
  inspector: InspectorView,
  timing: TimingView,
  links: LinksView,
};

export function App() {
  const Content = contents[view.value];
  return (
    <>
      <PageHeader />
      <main>
        {problem.value && (
          <p class="problem" role="alert">
            <span aria-hidden="true">✖ </span>
            {problem.value}
          </p>
        )}
        {needsToken.value ? <SignIn /> : <Content />}
      </main>
      <PageFooter />
      <Help />
    </>
  );
}
