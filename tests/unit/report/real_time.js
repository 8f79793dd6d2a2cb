// A self-test in real time with frames. The browser writes the page after the load event, which waits for the test.

/** Adds the page's errors to the complaints. An open iframe delays the load event. */
async function inRealTime(act) {
  const errors = [];
  addEventListener('error', ({message, error}) => errors.push(`an error in the page: ${message} ${error?.stack ?? ''}`));
  addEventListener('unhandledrejection', ({reason}) => errors.push(`a rejection in the page: ${reason?.stack ?? reason}`));
  for (const name of ['error', 'warn']) {
    const own = console[name];
    console[name] = (...words) => (errors.push(`console.${name}: ${words.join(' ')}`), own.apply(console, words));
  }
  const held = document.createElement('iframe');
  held.hidden = true;
  document.body.append(held);
  held.contentDocument.open();
  const late = new Promise((_, fail) => setTimeout(() => fail(new Error('the self-test takes more than five minutes')), 300000));
  try {
    const seen = await Promise.race([act(), late]);
    return {...seen, lines: [...seen.lines ?? [], ...errors]};
  } finally {
    setTimeout(() => held.contentDocument.close(), 100);
  }
}
